#include "terrane/web/page.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/map/map_tile.h"

namespace terrane::web {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

bool hasFile(std::string_view name) {
    return std::ranges::find(pageFiles(), name, &base::EmbeddedFile::path) != pageFiles().end();
}

std::string textOfFile(std::string_view name) {
    EXPECT_TRUE(hasFile(name)) << name;
    return hasFile(name) ? std::string(std::ranges::find(pageFiles(), name, &base::EmbeddedFile::path)->data)
                         : std::string();
}

std::vector<std::string> allMatches(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
        found.push_back((*match)[1]);
    return found;
}

TEST(Page, EachFileThatItNamesIsThere) {
    const std::string html = textOfFile("index.html");
    const auto names = allMatches(html, std::regex("(?:src|href)=\"([^\"]+)\""));
    EXPECT_GE(names.size(), 5u);
    for (const std::string& name : names) {
        if (name == "world.js") continue;  // generated for each world
        EXPECT_FALSE(textOfFile(name).empty()) << name;
        EXPECT_NE(typeOf(name), "application/octet-stream") << name;
    }
    EXPECT_THAT(names, testing::Contains("world.js"));
    // The page has no inline scripts or styles (web_server.cpp) and no links to other hosts.
    EXPECT_FALSE(std::regex_search(html, std::regex("<script>|<style>| on[a-z]+=|style=|https?://")));
}

TEST(Page, OtherFilesAreNot) {
    for (const char* name : {"", "world.js", "package.json", "../index.html", "/index.html", "INDEX.HTML"})
        EXPECT_FALSE(hasFile(name)) << name;
}

TEST(Page, FilesHaveTypes) {
    EXPECT_THAT(typeOf("index.html"), StartsWith("text/html"));
    EXPECT_THAT(typeOf("map.js"), StartsWith("text/javascript"));
    EXPECT_THAT(typeOf("leaflet.css"), StartsWith("text/css"));
    EXPECT_EQ(typeOf("icon.png"), "image/png");
    EXPECT_EQ(typeOf("png"), "application/octet-stream");
    for (const base::EmbeddedFile& file : pageFiles())
        EXPECT_NE(typeOf(file.path), "application/octet-stream") << file.path;
}

// The texts of each language by key: "en: { key: 'text', … },".
std::map<std::string, std::map<std::string, std::string>> pageTexts() {
    const std::string script = textOfFile("texts.js");
    std::map<std::string, std::map<std::string, std::string>> languages;
    const std::regex language("\\n    ([a-z]{2}): \\{([^]*?)\\n    \\},"), entry("(\\w+): '([^']*)'");
    for (std::sregex_iterator match(script.begin(), script.end(), language), end; match != end; ++match) {
        const std::string body = (*match)[2];
        for (std::sregex_iterator text(body.begin(), body.end(), entry); text != end; ++text)
            languages[(*match)[1]][(*text)[1]] = (*text)[2];
    }
    return languages;
}

// The placeholders in braces.
std::set<std::string> valuesIn(const std::string& text) {
    const auto words = allMatches(text, std::regex("\\{(\\w+)\\}"));
    return {words.begin(), words.end()};
}

TEST(Page, EachLanguageHasAllTexts) {
    const auto languages = pageTexts();
    ASSERT_EQ(languages.size(), 3u);
    const auto& english = languages.at("en");
    EXPECT_GT(english.size(), 20u);
    for (const auto& [name, texts] : languages) {
        EXPECT_EQ(texts.size(), english.size()) << name;
        for (const auto& [key, text] : english) {
            ASSERT_TRUE(texts.contains(key)) << name << ": " << key;
            EXPECT_FALSE(texts.at(key).empty()) << name << ": " << key;
            EXPECT_EQ(valuesIn(texts.at(key)), valuesIn(text)) << name << ": " << key;
        }
    }
}

TEST(Page, TextsThatItAsksForAreThere) {
    const auto english = pageTexts().at("en");
    for (const std::string& key :
         allMatches(textOfFile("index.html"), std::regex("data-text[a-z-]*=\"(\\w+)\"")))
        EXPECT_TRUE(english.contains(key)) << key;
    for (int k = 0; k < map::kLayerCount; ++k)
        EXPECT_TRUE(english.contains(std::string(map::nameOf(static_cast<map::Layer>(k)))));
}

PageInfo someFacts() {
    return {.identity = {~std::uint64_t{0}, "overworld", 3},
            .name = "Ada's \"world\" </script>",
            .spawn = {"spawn", 1.26, -2.0, 80.5},
            .places = {{"\xC4\x8C"
                        "echy",
                        5, 6, 7},
                       {"broken \xFF text", 0, 0, 0}},
            .layers = {"day", "night"},
            .minZoom = -10,
            .maxZoom = 2};
}

TEST(Page, FactsAreJson) {
    const auto json = nlohmann::json::parse(textOf(someFacts()));
    EXPECT_EQ(json["name"], "Ada's \"world\" </script>");
    EXPECT_EQ(json["seed"], "18446744073709551615") << "a text: numbers of JavaScript are too small";
    EXPECT_EQ(json["generator"], "overworld");
    EXPECT_EQ(json["spawn"]["x"], 1.3);
    EXPECT_EQ(json["layers"], (nlohmann::json{"day", "night"}));
    EXPECT_EQ(json["minZoom"], -10);
    EXPECT_EQ(json["places"].size(), 2u);
    EXPECT_EQ(json["places"][0]["name"],
              "\xC4\x8C"
              "echy");
    EXPECT_EQ(json["places"][1]["name"], "broken \xEF\xBF\xBD text");
    EXPECT_TRUE(json["isLive"]);
    EXPECT_EQ(textOf(someFacts()).find('\n'), std::string::npos) << "one line";
}

TEST(Page, TheSeaLevelIsThatOfTheGenerator) {
    for (const gen::CatalogueEntry& entry : gen::builtInGenerators()) {
        PageInfo info = someFacts();
        info.identity.generator = entry.name;
        EXPECT_EQ(nlohmann::json::parse(textOf(info))["seaLevel"], entry.seaLevel) << entry.name;
    }
}

TEST(Page, FactsWithoutPlacesAreLists) {
    const auto json = nlohmann::json::parse(textOf(PageInfo{}));
    EXPECT_TRUE(json["places"].is_array());
    EXPECT_TRUE(json["layers"].is_array());
    EXPECT_EQ(textOf(std::vector<MapMarker>()), "[]");
}

TEST(Page, TheScriptSetsTheFacts) {
    const std::string script = scriptOf(someFacts()), begin = "window.terraneWorld = ";
    ASSERT_THAT(script, StartsWith(begin));
    ASSERT_THAT(script, testing::EndsWith(";\n"));
    EXPECT_EQ(script.substr(begin.size(), script.size() - begin.size() - 2), textOf(someFacts()));
    EXPECT_THAT(textOfFile("map.js"), HasSubstr("terraneWorld"));
}

TEST(Page, PlacesWithNamesOfPlayersAreOneLine) {
    const std::vector<MapMarker> places = {
        {"line\nend\r\n\nevent: evil", 1, 2, std::numeric_limits<double>::quiet_NaN()}};
    const std::string text = textOf(places);
    EXPECT_EQ(text.find_first_of("\r\n"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(text)[0]["name"], "line\nend\r\n\nevent: evil");
}

}  // namespace
}  // namespace terrane::web
