#include "apps/terrane/window/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "apps/terrane/window/settings/key_help.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/render/frame/graphics_table.h"

namespace terrane::app {
namespace {

std::string contentOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

// The text of adjacent string literals that begin at `at`; empty if there are none.
std::string literalAt(std::string_view source, std::size_t at) {
    std::string text;
    while (true) {
        at = source.find_first_not_of(" \n", at);
        if (at == source.npos || source[at] != '"') return text;
        for (++at; source[at] != '"'; ++at) {
            const bool isEscape = source[at] == '\\';
            if (isEscape) ++at;
            text += isEscape && source[at] == 'n' ? '\n' : source[at];
        }
        ++at;
    }
}

// The texts of all calls tr("…"), tr_("…") and trLater("…"); "…" itself occurs in comments.
std::set<std::string> textsIn(std::string_view source) {
    std::set<std::string> texts;
    for (const std::string_view call : {"tr(", "tr_(", "trLater("}) {
        for (std::size_t at = source.find(call); at != source.npos; at = source.find(call, at + 1)) {
            const bool isName = at > 0 && (std::isalnum(static_cast<unsigned char>(source[at - 1])) != 0 ||
                                           source[at - 1] == '_');
            std::string text = isName ? "" : literalAt(source, at + call.size());
            if (!text.empty() && text != "…") texts.insert(std::move(text));
        }
    }
    return texts;
}

// Those of the module that draws, which knows no languages.
std::set<std::string> textsOfDrawing() {
    std::set<std::string> texts;
    const auto add = [&](const char* text) {
        if (text) texts.insert(text);
    };
    for (const render::GraphicsRow& row : render::graphicsTable()) {
        add(row.label);
        add(row.tip);
        for (const char* label : row.valueLabels) add(label);
    }
    for (const render::Preset& preset : render::presets()) {
        add(preset.label);
        add(preset.about);
    }
    return texts;
}

std::set<std::string> textsOfTheProgram() {
    std::set<std::string> texts;
    for (const auto& file : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(TERRANE_SOURCE_DIR) / "apps/terrane")) {
        const auto extension = file.path().extension();
        if (extension == ".cpp" || extension == ".h") texts.merge(textsIn(contentOf(file.path())));
    }
    texts.merge(textsOfDrawing());
    return texts;
}

TEST(Text, TextsInSourcesAreFound) {
    EXPECT_THAT(
        textsIn("Button(tr(\"a \\\"b\\\"\")), say(tr_(\n  \"one \"\n  \"two\")), attr(\"no\"), tr(name)"),
        testing::ElementsAre("a \"b\"", "one two"));
    EXPECT_THAT(textsIn("{trLater(\"c\\nd\")}"), testing::ElementsAre("c\nd"));
}

TEST(Text, EveryTextIsTranslated) {
    const std::set<std::string> texts = textsOfTheProgram();
    EXPECT_GT(texts.size(), 20u);
    for (const char* code : {"cs", "de"}) {
        const content::Language language = content::loadLanguage(code).value();
        for (const std::string& text : texts)
            EXPECT_TRUE(language.texts.contains(text))
                << "assets/languages/" << code << ".toml lacks \"" << text << "\"";
    }
}

// Biomes are shown in the facts about a place: tr() gets their names from the generator.
TEST(Text, BiomesAreTexts) {
    const std::set<std::string> texts = textsOfTheProgram();
    for (const gen::CatalogueEntry& entry : gen::builtInGenerators())
        for (const std::string_view biome : entry.biomes)
            EXPECT_TRUE(texts.contains(std::string(biome)))
                << "apps/terrane/window/hud/places_panel.cpp lacks \"" << biome << "\" of " << entry.name;
}

// Each action that has a key by default is in one line, with the key that the player chose.
TEST(KeyHelp, HasThePlayersKeys) {
    for (const ActionRow& row : actionTable()) {
        KeyBindings bindings;
        if (!bindings.keyOf(row.action)) continue;  // buttons or the wheel do it
        const auto before = keyHelpLines(bindings, {});
        bindings.bind(row.action, Key::F9);  // no default
        const auto after = keyHelpLines(bindings, {});
        ASSERT_EQ(before.size(), after.size());
        int changed = 0;
        for (std::size_t k = 0; k < after.size(); ++k) {
            if (before[k].keys == after[k].keys) continue;
            ++changed;
            EXPECT_THAT(after[k].keys, testing::HasSubstr("F9")) << row.name;
        }
        EXPECT_EQ(changed, 1) << row.name;
    }
}

TEST(KeyHelp, IsInThePlayersLanguage) {
    KeyBindings bindings;
    bindings.unbind(Action::Run);
    EXPECT_THAT(
        keyHelpLines(bindings, textsOf("de")),
        testing::Contains(testing::AllOf(testing::Field(&KeyHelpLine::keys, "Leertaste, keine"),
                                         testing::Field(&KeyHelpLine::effect,
                                                        "springen, zweimal schnell: fliegen oder landen; "
                                                        "rennen, schneller fliegen"))));
}

TEST(KeyHelp, IsATextInTwoColumns) {
    EXPECT_THAT(keyHelpText(), testing::HasSubstr("\n  W, A, S, D          walk\n"));
    EXPECT_THAT(keyHelpText(), testing::EndsWith("\n  Esc                 close what is open, else the menu: "
                                                 "settings, save and quit\n"));
}

TEST(Text, TranslatesAsAskedFor) {
    EXPECT_STREQ(textsOf("de")("Keep playing"), "Weiterspielen");
    EXPECT_STREQ(textsOf("en")("Keep playing"), "Keep playing");
    EXPECT_STREQ(Texts()("Keep playing"), "Keep playing");
}

TEST(Text, TheEnvironmentChooses) {
    for (const char* variable : {"LC_ALL", "LC_MESSAGES", "LANG"}) ::unsetenv(variable);
    EXPECT_EQ(languageCode("auto"), "en");
    ::setenv("LANG", "de_DE.UTF-8", 1);
    EXPECT_EQ(languageCode("auto"), "de");
    ::setenv("LC_MESSAGES", "cs_CZ.UTF-8", 1);
    EXPECT_EQ(languageCode("auto"), "cs");
    ::setenv("LC_ALL", "C", 1);
    EXPECT_EQ(languageCode("auto"), "en");
    EXPECT_EQ(languageCode("de"), "de");
    for (const char* variable : {"LC_ALL", "LC_MESSAGES", "LANG"}) ::unsetenv(variable);
}

}  // namespace
}  // namespace terrane::app
