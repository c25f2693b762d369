#include "apps/terrane/window/text.h"

#include <fmt/format.h>

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

std::string refusalText(game::EditResult result, const Texts& tr) {
    if (result == game::EditResult::NotEmpty) return tr("it is not empty: take everything out first");
    if (result == game::EditResult::Protected) return tr("the lowest layer of the world cannot be broken");
    if (result == game::EditResult::Claimed) return tr("this place belongs to somebody else");
    if (result == game::EditResult::NotAllowed) return tr("guests cannot change anything");
    if (result == game::EditResult::NoRoom) return tr("you have no room for what it gives");
    if (result == game::EditResult::Creative) return tr("that works only in creative");
    return {};
}

std::string takenBackText(const game::UndoResult& done, game::HistoryWay way, const Texts& tr) {
    using Outcome = game::UndoResult::Outcome;
    const bool isUndo = way == game::HistoryWay::Undo;
    if (done.outcome == Outcome::Sent || done.outcome == Outcome::Refused) return {};
    if (done.outcome == Outcome::NoStep) return isUndo ? tr("nothing to undo") : tr("nothing to redo");
    if (done.outcome == Outcome::NotLoaded) return tr("too far away: the place of that edit is not loaded");
    if (done.outcome == Outcome::NotAllowed) return tr("you may not change a part of it");
    const char* what = isUndo ? tr("undone: {} blocks") : tr("redone: {} blocks");
    std::string text = fmt::format(fmt::runtime(what), done.blocks);
    if (done.skipped > 0)
        text += fmt::format(fmt::runtime(tr(", {} changed since then and stay")), done.skipped);
    return text;
}

}  // namespace terrane::app
