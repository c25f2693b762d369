#include "apps/terrane/window/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "apps/terrane/window/key_help_table.h"

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

std::set<std::string> textsOfTheProgram() {
    std::set<std::string> texts;
    for (const auto& file : std::filesystem::recursive_directory_iterator(
             std::filesystem::path(TERRANE_SOURCE_DIR) / "apps/terrane")) {
        const auto extension = file.path().extension();
        if (extension == ".cpp" || extension == ".h") texts.merge(textsIn(contentOf(file.path())));
    }
    return texts;
}

std::set<std::string> textsOfKeys() {
    std::set<std::string> texts;
    for (const KeyHelpLine& line : keyHelpLines()) {
        texts.insert(line.action);
        // Names of single keys are not translated.
        const bool isWords =
            line.keys.find("button") != line.keys.npos || line.keys.find("wheel") != line.keys.npos;
        if (isWords) texts.insert(line.keys);
    }
    return texts;
}

TEST(Text, TextsInSourcesAreFound) {
    EXPECT_THAT(
        textsIn("Button(tr(\"a \\\"b\\\"\")), say(tr_(\n  \"one \"\n  \"two\")), attr(\"no\"), tr(name)"),
        testing::ElementsAre("a \"b\"", "one two"));
    EXPECT_THAT(textsIn("{trLater(\"c\\nd\")}"), testing::ElementsAre("c\nd"));
}

TEST(Text, EveryTextIsTranslated) {
    std::set<std::string> texts = textsOfTheProgram();
    EXPECT_GT(texts.size(), 20u);
    texts.merge(textsOfKeys());
    for (const char* code : {"cs", "de"}) {
        const content::Language language = content::loadLanguage(code).value();
        for (const std::string& text : texts)
            EXPECT_TRUE(language.texts.contains(text))
                << "assets/languages/" << code << ".toml lacks \"" << text << "\"";
    }
}

TEST(Text, KeysAreInTwoColumns) {
    const auto lines = keyHelpLines();
    ASSERT_GT(lines.size(), 5u);
    for (const KeyHelpLine& line : lines) {
        EXPECT_FALSE(line.keys.empty());
        EXPECT_FALSE(line.action.empty()) << line.keys;
    }
    EXPECT_EQ(lines.back().keys, "Esc");
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
