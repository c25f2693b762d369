#include "apps/terrane/window/text.h"

#include <cstdlib>

#include "terrane/base/log.h"

namespace terrane::app {

std::vector<std::pair<std::string, std::string>> languageChoices() {
    std::vector<std::pair<std::string, std::string>> choices = {{"auto", "auto"}};
    for (const std::string_view code : content::kLanguages) choices.emplace_back(code, code);
    return choices;
}

std::string_view languageCode(const std::string& choice) {
    if (choice != "auto") return choice;
    for (const char* variable : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
        const char* locale = std::getenv(variable);
        if (locale && *locale) return content::languageOfLocale(locale);
    }
    return content::kLanguages[0];
}

Texts textsOf(const std::string& choice) {
    auto language = content::loadLanguage(languageCode(choice));
    if (language) return {std::move(*language)};
    base::logWarning("{}", language.error().message);
    return {};
}

Texts textsOf(const std::string& choice, const pack::Content& content) {
    Texts texts = textsOf(choice);
    if (auto added = pack::addBlockNames(texts.language, content, languageCode(choice)); !added)
        base::logWarning("{}", added.error().message);
    return texts;
}

}  // namespace terrane::app
