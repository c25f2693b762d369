#include "apps/terrane/record/script.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrane/content/built_in.h"

namespace terrane::app {
namespace {

using testing::HasSubstr;

const world::BlockRegistry& blocks() {
    static const world::BlockRegistry registry = *content::loadBlocks();
    return registry;
}

base::Result<Script> parse(const std::string& text, ScriptDefaults defaults = {}) {
    defaults.graphics.choices.preset = "high";
    return parseScript(text, "p.toml", defaults, blocks());
}

std::string errorOf(const std::string& text) {
    const auto script = parse(text);
    return script ? "no error" : script.error().message;
}

render::GraphicsSettings settingsAt(const view::Shot& shot, double seconds) {
    return render::settingsOf(view::optionsAt(shot, seconds).choices, true);
}

constexpr const char* kKey = "[[shot.key]]\nat = [1, 2, 3]\nlook = [0, 0]\n";

std::string shotOf(const std::string& more, const std::string& head = "seconds = 10\n") {
    return "[[shot]]\n" + head + kKey + more;
}

TEST(ScriptFile, ReadsEverything) {
    const auto script = parse(R"(
seed = 7
generator = "flat"
[options]
preset = "low"
view-distance = 5

[[shot]]
name = "first"
seconds = 4
key = [
    { at = [1, 2, 3.5], look = [90, -5], day = 0.3 },
    { time = 3, at = [4, 5, 6] },
]
title = [{ text = "Hello", place = "middle" }, { time = 1, seconds = 2, text = "a\nb" }]
set = [{ time = 2, ssao = "on", aggregation = "none" }, { time = 1, view = "light" }]
edit = [
    { time = 3, at = [1, 1, 70], block = "stone" },
    { time = 1, seconds = 2, from = [5, 5, 70], to = [3, 4, 71], block = "lamp_red" },
]

[[shot]]
[[shot.key]]
at = [0, 0, 0]
look-at = [1, 1, 1]
[[shot.key]]
time = 2.5
at = [0, 9, 0]
)");
    ASSERT_TRUE(script) << script.error().message;
    EXPECT_EQ(script->world.seed, 7u);
    EXPECT_EQ(script->world.generator, "flat");
    ASSERT_EQ(script->shots.size(), 2u);
    const view::Shot &first = script->shots[0], &second = script->shots[1];
    EXPECT_EQ(first.name, "first");
    EXPECT_EQ(first.seconds, 4);
    EXPECT_EQ(first.path.at(0).camera.position, glm::dvec3(1, 2, 3.5));
    EXPECT_FLOAT_EQ(first.path.at(3).camera.yaw, 90) << "a key keeps what the one before it has";
    EXPECT_FLOAT_EQ(first.path.at(3).timeDay, 0.3f);
    ASSERT_EQ(first.titles.size(), 2u);
    EXPECT_TRUE(first.titles[0].isLarge);
    EXPECT_FALSE(first.titles[1].isLarge);
    EXPECT_EQ(first.titles[1].text, "a\nb");
    ASSERT_EQ(first.edits.size(), 2u);
    EXPECT_EQ(first.edits[0].time, 1) << "edits are in the order of time";
    EXPECT_EQ(first.edits[0].box.low, (world::BlockPos{3, 4, 70}));
    EXPECT_EQ(first.edits[0].box.high, (world::BlockPos{5, 5, 71}));
    EXPECT_EQ(first.edits[0].box.blockCount(), 12);
    EXPECT_EQ(first.edits[1].block, blocks().find("stone")->id);
    EXPECT_EQ(second.start, 4);
    EXPECT_EQ(second.seconds, 2.5) << "as long as its keys";
    EXPECT_EQ(script->seconds(), 6.5);
}

TEST(ScriptFile, ReadsPlayersWhoBuild) {
    const std::string player =
        "[[shot.player]]\nname = \"Ann\"\nnumber = 3\nkey = [{ at = [5, 6, 70], look = [0, 0] }]\n";
    const std::string edit = "[[shot.edit]]\nat = [1, 1, 70]\nblock = \"stone\"\nplayer = \"Ann\"\n";
    const auto script = parse(shotOf(edit + player));
    ASSERT_TRUE(script) << script.error().message;
    const view::Shot& shot = script->shots[0];
    ASSERT_EQ(shot.players.size(), 1u);
    EXPECT_EQ(shot.players[0].name, "Ann");
    EXPECT_EQ(shot.players[0].number, 3u);
    EXPECT_EQ(shot.players[0].path.at(0).camera.position, glm::dvec3(5, 6, 70));
    EXPECT_EQ(shot.edits[0].player, "Ann");
    EXPECT_THAT(errorOf(shotOf(edit)), HasSubstr("player: expected the name of a player of the shot"));
    EXPECT_THAT(errorOf(shotOf("[[shot.player]]\nname = \"Ann\"\n")), HasSubstr("key"));
    EXPECT_THAT(
        errorOf(shotOf(
            "[[shot.player]]\nname = \"Ann\"\nnumber = 2.5\nkey = [{ at = [5, 6, 70], look = [0, 0] }]\n")),
        HasSubstr("number: expected a whole number"));
    EXPECT_THAT(errorOf(shotOf("[[shot.player]]\nkey = [{ at = [5, 6, 70], look = [0, 0] }]\n")),
                HasSubstr("name"));
}

TEST(ScriptFile, OptionsHoldUntilTheyChangeAndForOneShot) {
    const auto script = parse("[options]\nview-distance = 5\nssao = \"raw\"\n" +
                              shotOf("[[shot.set]]\ntime = 2\nssao = \"on\"\nview = \"depth\"\n"
                                     "[[shot.set]]\ntime = 1\nmerging = \"lines\"\n") +
                              shotOf(""));
    ASSERT_TRUE(script) << script.error().message;
    const auto occlusionAt = [&](std::size_t shot, double time) {
        return settingsAt(script->shots[shot], time).render.occlusion;
    };
    const view::Shot& shot = script->shots[0];
    EXPECT_EQ(settingsAt(shot, 0).viewDistance, 5);
    EXPECT_EQ(settingsAt(shot, 0).mesh.method, mesh::MergeMethod::Greedy);
    EXPECT_EQ(settingsAt(shot, 1).mesh.method, mesh::MergeMethod::Lines);
    EXPECT_EQ(view::optionsAt(shot, 1.99).view, render::View::Color);
    EXPECT_EQ(view::optionsAt(shot, 2).view, render::View::Depth);
    EXPECT_EQ(settingsAt(shot, 9).mesh.method, mesh::MergeMethod::Lines);
    EXPECT_EQ(occlusionAt(0, 0), render::Occlusion::Raw);
    EXPECT_EQ(occlusionAt(0, 3), render::Occlusion::On);
    EXPECT_EQ(occlusionAt(1, 3), render::Occlusion::Raw);
    EXPECT_EQ(view::optionsAt(script->shots[1], 0).view, render::View::Color);
}

TEST(ScriptFile, FormerNamesOfOptionsAreRead) {
    const auto script =
        parse("[options]\nview = \"aggregation\"\natmosphere = \"off\"\n" +
              shotOf("[[shot.set]]\ntime = 1\naggregation = \"lines\"\nregion-height = 32\n"));
    ASSERT_TRUE(script) << script.error().message;
    const view::Shot& shot = script->shots[0];
    EXPECT_EQ(view::optionsAt(shot, 0).view, render::View::Merging);
    EXPECT_FALSE(settingsAt(shot, 0).render.distanceFog);
    EXPECT_EQ(settingsAt(shot, 1).mesh.method, mesh::MergeMethod::Lines);
    EXPECT_EQ(settingsAt(shot, 1).mesh.meshSectionHeight, 32);
}

TEST(ScriptFile, TheCommandLineWins) {
    ScriptDefaults defaults;
    defaults.world.seed = 3;
    defaults.graphics.choices.viewDistance = 2;
    defaults.given = {"seed", "view-distance"};
    const std::string text =
        "seed = 9\ngenerator = \"flat\"\n[options]\nview-distance = 8\nview = \"depth\"\n" +
        shotOf("[[shot.set]]\nview-distance = 9\n");
    const auto script = parse(text, defaults);
    ASSERT_TRUE(script) << script.error().message;
    EXPECT_EQ(script->world.seed, 3u);
    EXPECT_EQ(script->world.generator, "flat");
    EXPECT_EQ(settingsAt(script->shots[0], 5).viewDistance, 2);
    EXPECT_EQ(view::optionsAt(script->shots[0], 5).view, render::View::Depth);
}

TEST(ScriptFile, APresetOfTheCommandLineStandsAlone) {
    ScriptDefaults defaults;
    defaults.graphics.choices.preset = "low";
    defaults.graphics.choices.viewDistance = 2;
    const std::string text =
        "[options]\npreset = \"high\"\nclouds = \"on\"\nview-distance = 8\nhorizon = 512\n" +
        shotOf("[[shot.set]]\nssao = \"raw\"\nview = \"depth\"\n");
    const auto choicesWith = [&](std::vector<std::string> given) {
        defaults.given = std::move(given);
        const auto script = parseScript(text, "p.toml", defaults, blocks());
        EXPECT_TRUE(script);
        EXPECT_EQ(view::optionsAt(script->shots[0], 5).view, render::View::Depth) << "no part of a preset";
        EXPECT_EQ(settingsAt(script->shots[0], 5).viewDistance, 8) << "no part of a preset";
        EXPECT_EQ(settingsAt(script->shots[0], 5).horizon, 512) << "no part of a preset";
        return view::optionsAt(script->shots[0], 5).choices;
    };
    EXPECT_EQ(choicesWith({"preset"}).preset, "low");
    EXPECT_EQ(choicesWith({"preset"}).changed.size(), 1u) << "the horizon";
    EXPECT_EQ(choicesWith({}).preset, "high");
    EXPECT_EQ(choicesWith({}).changed.size(), 3u);
}

TEST(ScriptFile, ShotsFollowEachOther) {
    const auto script = parse(shotOf("", "seconds = 0.1\n") + shotOf("", "seconds = 0.2\n") + shotOf(""));
    ASSERT_TRUE(script) << script.error().message;
    EXPECT_EQ(&view::shotAt(script->shots, 0), &script->shots[0]);
    EXPECT_EQ(&view::shotAt(script->shots, 0.1), &script->shots[1]);
    EXPECT_EQ(&view::shotAt(script->shots, 0.3), &script->shots[2]) << "0.1 + 0.2 is more than 0.3 in binary";
    EXPECT_EQ(&view::shotAt(script->shots, 99), &script->shots[2]);
}

struct WrongFile {
    std::string text, error;
};

TEST(ScriptFile, PlacesReachBothEndsOfTheWorld) {
    const std::string edit = "[[shot.edit]]\nblock = \"stone\"\nat = [-2147483648, 2147483647, 0]\n";
    for (const auto& [text, position] :
         {std::pair("-2147483648, -2147483648.0", glm::dvec2(-2147483648.0)),
          std::pair("2147483647, 2147483647.9", glm::dvec2(2147483647, 2147483647.9))}) {
        const auto script =
            parse(fmt::format("[[shot]]\nseconds = 1\n[[shot.key]]\nat = [{}, 9]\nlook-at = [3e9, -3e9, 0]\n",
                              text) +
                  edit);
        ASSERT_TRUE(script) << script.error().message;
        EXPECT_EQ(glm::dvec2(script->shots[0].path.at(0).camera.position), position);
        EXPECT_EQ(script->shots[0].edits[0].box.low, (world::BlockPos{-2147483647 - 1, 2147483647, 0}));
    }
}

TEST(ScriptFile, ErrorsNameFileLineAndKey) {
    const std::string edit = "[[shot.edit]]\nblock = \"stone\"\n";
    const std::vector<WrongFile> cases = {
        {"", "p.toml:"},
        {"seed = ", "p.toml:1: "},
        {"\nspeed = 1\n", "p.toml:2: speed: unknown key"},
        {"\n\nseed = \"+1\"\n" + shotOf(""), "p.toml:3: seed: expected a whole number"},
        {"[options]\nseed = 1\n", "p.toml:2: seed: unknown key"},
        {"[options]\nssao = \"maybe\"\n", "p.toml:2: ssao: expected one of off, on, raw, got \"maybe\""},
        {"[options]\nsize = \"2x2\"\n", "p.toml:2: size: unknown key"},
        {"[options]\nview-distance = 99\n", "p.toml:2: view-distance: "},
        {"options = 3\n", "p.toml:1: options: expected a table"},
        {"shot = 3\n", "p.toml:1: shot: expected an array of tables"},
        {"shot = [3]\n", "p.toml:1: shot: expected a table"},
        {"[[shot]]\nseconds = 1\n", "p.toml:1: key: missing"},
        {"[[shot]]\n[[shot.key]]\nlook = [0, 0]\n", "p.toml:2: at: missing"},
        {"[[shot]]\n[[shot.key]]\nat = [0, 0, 0]\n", "p.toml:2: look: missing"},
        {"[[shot]]\n[[shot.key]]\nat = [0, 0]\nlook = [0, 0]\n", "p.toml:3: at: expected [x, y, z]"},
        {"[[shot]]\n[[shot.key]]\nat = [0, \"a\", 0]\nlook = [0, 0]\n", "p.toml:3: at: expected [x, y, z]"},
        {"[[shot]]\n[[shot.key]]\nat = [0, nan, 0]\nlook = [0, 0]\n", "p.toml:3: at: expected [x, y, z]"},
        {"[[shot]]\n[[shot.key]]\nat = [0, 3e9, 0]\nlook = [0, 0]\n", "p.toml:2: at: outside the world"},
        {"[[shot]]\n[[shot.key]]\nat = [2147483648, 0, 0]\nlook = [0, 0]\n",
         "p.toml:2: at: outside the world"},
        {"[[shot]]\n[[shot.key]]\nat = [-2147483648.1, 0, 0]\nlook = [0, 0]\n",
         "p.toml:2: at: outside the world"},
        {"[[shot]]\n[[shot.key]]\nat = [0, 0, 0]\nlook = [0, 91]\n", "p.toml:4: look: "},
        {"[[shot]]\n[[shot.key]]\nat = [0, 0, 0]\nlook-at = [0, 0, 0]\n", "p.toml:2: look-at: is where"},
        {"[[shot]]\n[[shot.key]]\nat = [0, 0, 0]\nlook-at = [0, 0, 1]\nlook = [0, 0]\n", "only one of"},
        {shotOf("[[shot.key]]\nat = [0, 0, 0]\n"), "p.toml:6: time: missing"},
        {shotOf("[[shot.key]]\ntime = 0\n"), "p.toml:6: time: must be after 0"},
        {shotOf("[[shot.key]]\ntime = 1\nlook-at = [0, 0, 1]\n"), "p.toml:6: look: the keys of a shot"},
        {shotOf("[[shot.key]]\ntime = 11\n"), "p.toml:1: seconds: the shot has a key at 11"},
        {shotOf("", ""), "p.toml:1: seconds: "},
        {shotOf("", "seconds = \"a\"\n"), "p.toml:2: seconds: expected a number"},
        {shotOf("[[shot.title]]\n"), "p.toml:6: text: missing"},
        {shotOf("[[shot.title]]\ntext = \"\"\n"), "p.toml:7: text: expected a text"},
        {shotOf("[[shot.title]]\ntext = \"a\u2192\"\n"),
         "p.toml:7: text: expected letters of ISO 8859-1 (not \u2192)"},
        {shotOf("[[shot.title]]\ntext = \"a\"\nplace = \"top\"\n"),
         "p.toml:8: place: expected one of bottom, middle"},
        {shotOf("[[shot.title]]\ntime = 11\ntext = \"a\"\n"),
         "p.toml:7: time: expected a number from 0 to 10"},
        {shotOf("[[shot.set]]\nblur = 1\n"), "p.toml:7: blur: unknown key"},
        {shotOf(edit), "p.toml:6: at: needs either at, or from and to"},
        {shotOf(edit + "from = [0, 0, 0]\n"), "p.toml:6: at: needs either"},
        {shotOf(edit + "at = [0, 0, 2048]\n"), "p.toml:8: at: expected [x, y, z] of a block"},
        {shotOf(edit + "at = [0, 0.5, 0]\n"), "p.toml:8: at: expected [x, y, z] of a block"},
        {shotOf(edit + "at = [2147483648, 0, 0]\n"), "p.toml:8: at: expected [x, y, z] of a block"},
        {shotOf(edit + "at = [0, -2147483649, 0]\n"), "p.toml:8: at: expected [x, y, z] of a block"},
        {shotOf(edit + "from = [0, 0, 0]\nto = [2000, 2000, 9]\n"), "p.toml:6: to: more than 262144 blocks"},
        {shotOf("[[shot.edit]]\nat = [0, 0, 0]\nblock = \"cheese\"\n"), "p.toml:8: block: expected a name"},
        {shotOf("[[shot.edit]]\nat = [0, 0, 0]\n"), "p.toml:6: block: missing"},
    };
    for (const WrongFile& wrong : cases)
        EXPECT_THAT(errorOf(wrong.text), HasSubstr(wrong.error)) << wrong.text;
}

}  // namespace
}  // namespace terrane::app
