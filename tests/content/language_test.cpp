#include "terrane/content/language.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrane/content/built_in.h"
#include "terrane/world/items/item_table.h"

namespace terrane::content {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

std::string errorOf(std::string_view toml) {
    const auto language = parseLanguage(toml, "xx.toml");
    return language ? "" : language.error().message;
}

world::BlockType named(const char* name) {
    world::BlockType type;
    type.name = name;
    return type;
}

TEST(Language, EveryFileNamesEveryBlock) {
    const world::BlockRegistry blocks = loadBlocks().value();
    for (const std::string_view code : kLanguages) {
        const auto language = loadLanguage(code);
        ASSERT_TRUE(language) << language.error().message;
        for (const world::BlockType& type : blocks.types())
            EXPECT_TRUE(language->blocks.contains(type.name)) << code << ": " << type.name;
        for (const world::ItemType& item : blocks.items().types())
            EXPECT_TRUE(language->blocks.contains(item.name)) << code << ": " << item.name;
        for (const auto& [name, shown] : language->blocks)
            EXPECT_TRUE(blocks.find(name) || blocks.items().find(name)) << code << " names nothing: " << name;
    }
}

TEST(Language, NamesAreWords) {
    EXPECT_EQ(blockName(loadLanguage("en").value(), named("oak_log")), "Oak log");
    EXPECT_EQ(blockName(loadLanguage("cs").value(), named("oak_log")), "Dubový kmen");
    EXPECT_EQ(blockName(loadLanguage("de").value(), named("oak_log")), "Eichenstamm");
}

TEST(Language, BlocksWithoutANameHaveTheirOwnInWords) {
    EXPECT_EQ(blockName({}, named("tall_oak_log")), "Tall oak log");
    EXPECT_EQ(blockName({}, named("2_bricks")), "2 bricks");
    EXPECT_EQ(blockName({}, named("")), "");
}

TEST(Language, TextsThatAreNotTranslatedStayEnglish) {
    const Language language = parseLanguage("[text]\n'Keep playing' = 'Weiter'", "xx.toml").value();
    EXPECT_EQ(text(language, "Keep playing"), "Weiter");
    EXPECT_EQ(text(language, "Stop playing"), "Stop playing");
}

TEST(Language, FieldsOfATextAreThoseOfItsTranslation) {
    EXPECT_EQ(errorOf("[text]\n'For %.0f s, %zu' = 'Seit %.0f s, %zu'\n'at {}' = 'bei {}'"), "");
    EXPECT_THAT(errorOf("[text]\n'For %.0f s, %zu' = 'Seit %zu, %.0f s'"), StartsWith("xx.toml:2: text."));
    EXPECT_THAT(errorOf("[text]\n'a' = 'b %s'"), HasSubstr("expected the fields of the English text"));
    EXPECT_THAT(errorOf("[text]\n'at {:.1f}' = 'bei {}'"), HasSubstr("expected the fields"));
}

TEST(Language, FieldsAreFound) {
    EXPECT_THAT(textFields("For %.0f s; %zu chunks, 100 %%"), ElementsAre("%.0f", "%zu", "%%"));
    EXPECT_THAT(textFields("at {} and {:.1f}, {{ }}"), ElementsAre("{}", "{:.1f}", "{{", "}}"));
    EXPECT_THAT(textFields("{ 5 %"), ElementsAre("{", "%"));
    EXPECT_THAT(textFields("nothing"), IsEmpty());
}

TEST(Language, WrongFilesAreToldWithTheirLine) {
    EXPECT_THAT(errorOf("[blocks]\noak_log = 5"),
                StartsWith("xx.toml:2: blocks.\"oak_log\": expected a text"));
    EXPECT_THAT(errorOf("[blocks]\noak_log = ''"), HasSubstr("1 to 64 bytes"));
    EXPECT_THAT(errorOf("[blocks]\na = '" + std::string(65, 'x') + "'"), HasSubstr("1 to 64 bytes"));
    EXPECT_THAT(errorOf("[blocks]\na = \"two\\nlines\""), HasSubstr("that can be shown"));
    EXPECT_THAT(errorOf("[blocks]\na = \"\\u001b[1m\""), HasSubstr("that can be shown"));
    EXPECT_THAT(errorOf("[other]"), StartsWith("xx.toml:1: other: unknown key"));
    EXPECT_THAT(errorOf("text = 5"), HasSubstr("a table of at most 4096 texts"));
    EXPECT_THAT(errorOf("[text"), StartsWith("xx.toml:1: syntax: "));
    EXPECT_EQ(loadLanguage("tlh").error().code, base::ErrorCode::NotFound);
}

TEST(Language, FilesAreBounded) {
    std::string toml = "[text]\n";
    for (std::size_t k = 0; k <= kMaxLanguageEntries; ++k) toml += "t" + std::to_string(k) + " = 'x'\n";
    EXPECT_THAT(errorOf(toml), HasSubstr("at most 4096 texts"));
}

TEST(Language, LocalesOfTheSystem) {
    EXPECT_EQ(languageOfLocale("de_AT.UTF-8"), "de");
    EXPECT_EQ(languageOfLocale("cs_CZ"), "cs");
    EXPECT_EQ(languageOfLocale("cs"), "cs");
    EXPECT_EQ(languageOfLocale("C.UTF-8"), "en");
    EXPECT_EQ(languageOfLocale("fr_FR.UTF-8"), "en");
    EXPECT_EQ(languageOfLocale(""), "en");
}

}  // namespace
}  // namespace terrane::content
