// libFuzzer: any text as a language file.
#include "terrane/content/language.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrane;
    const auto language =
        content::parseLanguage(fuzz::FuzzInput(data, size).restAsText(), "languages/xx.toml");
    if (!language) {
        fuzz::requireReason(language.error());
        return 0;
    }
    for (const auto& [english, translation] : language->texts) {
        fuzz::require(content::text(*language, english) == translation);
        fuzz::require(content::textFields(english) == content::textFields(translation));
    }
    for (const auto& [name, shown] : language->blocks) {
        world::BlockType type;
        type.name = name;
        fuzz::require(content::blockName(*language, type) == shown);
        fuzz::require(!shown.empty() && shown.size() <= content::kMaxBlockNameText);
    }
    return 0;
}
