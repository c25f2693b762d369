#include "apps/terrane/settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "apps/terrane/graphics_options.h"
#include "apps/terrane/options.h"
#include "tests/base/temp_folder.h"

namespace terrane::app {
namespace {

const std::vector<std::string> kGraphics = {"preset", "clouds", "shadows"};

class Settings : public testing::Test {
  protected:
    void write(std::string_view text) { std::ofstream(file_) << text; }
    std::string written() const {
        std::ostringstream text;
        text << std::ifstream(file_).rdbuf();
        return text.str();
    }
    // The lines with settings.
    std::vector<std::string> lines() const {
        std::istringstream in(written());
        std::vector<std::string> found;
        for (std::string line; std::getline(in, line);) {
            if (!line.empty() && line[0] != '#') found.push_back(line);
        }
        return found;
    }
    using Lines = std::vector<std::string>;

    base::TempFolder folder_;
    std::filesystem::path file_ = folder_.path() / "terrane" / "settings.toml";
};

TEST_F(Settings, NothingIsWrittenWhereNothingChanged) {
    ASSERT_TRUE(writeChanges(file_, {{"movement", "fly"}}, {{"movement", "fly"}}, kGraphics));
    EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(Settings, OnlyWhatChangedIsWritten) {
    // Like `play --view-distance 40 --full-screen` and a press of M.
    ASSERT_TRUE(writeChanges(file_, {{"view-distance", "40"}, {"full-screen", "true"}, {"movement", "fly"}},
                             {{"view-distance", "40"}, {"full-screen", "true"}, {"movement", "walk"}},
                             kGraphics));
    EXPECT_EQ(lines(), (Lines{"movement = 'walk'"}));
}

TEST_F(Settings, WhatTheFileHasBesidesStays) {
    std::filesystem::create_directories(file_.parent_path());
    write("day-minutes = 3\nview-distance = 12\nfull-screen = true\n");
    ASSERT_TRUE(writeChanges(file_, {{"view-distance", "40"}, {"full-screen", "true"}},
                             {{"view-distance", "41"}}, kGraphics));
    EXPECT_EQ(lines(), (Lines{"day-minutes = 3", "view-distance = '41'"}));
}

TEST_F(Settings, AnotherPresetReplacesAllOfGraphics) {
    std::filesystem::create_directories(file_.parent_path());
    write("clouds = 'on'\nmovement = 'fast'\npreset = 'high'\n");
    // "clouds = on" is the former preset's value, so neither map has it.
    ASSERT_TRUE(
        writeChanges(file_, {{"preset", "high"}}, {{"preset", "low"}, {"shadows", "1024"}}, kGraphics));
    EXPECT_EQ(lines(), (Lines{"movement = 'fast'", "preset = 'low'", "shadows = '1024'"}));
}

TEST_F(Settings, CommentsAndOrderStay) {
    std::filesystem::create_directories(file_.parent_path());
    write(
        "# mine\n\nresource-pack = \"/ä/ö\"  # näher\n\"movement\" = 'walls' # for now\nday-minutes = 3\n"
        "clouds = 'on'  # gone\n# the end");
    ASSERT_TRUE(writeChanges(
        file_, {{"resource-pack", "/ä/ö"}, {"movement", "fly"}, {"clouds", "on"}, {"shadows", "1024"}},
        {{"resource-pack", "it's \"ü\""}, {"movement", "fast"}, {"shadows", "off"}, {"view-distance", "8"}},
        kGraphics));
    EXPECT_EQ(written(),
              "# mine\n\nresource-pack = \"it's \\\"ü\\\"\"  # näher\n\"movement\" = 'fast' # for now\n"
              "day-minutes = 3\n# the end\nshadows = 'off'\nview-distance = '8'\n");
}

TEST_F(Settings, AFormerNameBecomesTodaysWhenItsValueChanges) {
    std::filesystem::create_directories(file_.parent_path());
    write("aggregation = 'lines' # mine\natmosphere = 'off'\nbetter-texturing = 'off'\n");
    ASSERT_TRUE(writeChanges(file_,
                             {{"merging", "lines"}, {"distance-fog", "off"}, {"sharp-filtering", "off"}},
                             {{"merging", "none"}, {"sharp-filtering", "off"}}, kGraphics));
    EXPECT_EQ(lines(), (Lines{"merging = 'none' # mine", "better-texturing = 'off'"}));
}

TEST_F(Settings, FormerNamesAreRead) {
    std::filesystem::create_directories(file_.parent_path());
    write("aggregation = 'lines'\nview = 'aggregation'\nregion-height = 32\natmosphere = 'off'\n");
    CLI::App command;
    GraphicsOptions options;
    addGraphicsOptions(command, options, "low");
    const auto done = applySettings(file_, command, {"preset", "distance-fog"});
    ASSERT_TRUE(done) << done.error().message;
    const render::GraphicsSettings settings = render::settingsOf(options.choices, true);
    EXPECT_EQ(settings.mesh.method, mesh::MergeMethod::Lines);
    EXPECT_EQ(settings.mesh.meshSectionHeight, 32);
    EXPECT_EQ(options.view, render::View::Merging);
    EXPECT_FALSE(settings.render.distanceFog);
}

// They have their effect before the file is read.
TEST_F(Settings, OptionsOfTheCommandLineAloneAreRefused) {
    std::filesystem::create_directories(file_.parent_path());
    write("view-distance = 5\ntrace = 'trace.json'\n");
    CLI::App command;
    int viewDistance = 0;
    std::string trace;
    command.add_option("--view-distance", viewDistance);
    addTraceOption(command, trace);
    const auto done = applySettings(file_, command, {});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().message, file_.string() + ":2: trace: only on the command line");
    EXPECT_EQ(trace, "");
}

TEST_F(Settings, AnOptionTakesItsKindOfValue) {
    std::filesystem::create_directories(file_.parent_path());
    const auto errorOf = [&](const std::string& text) -> std::string {
        write(text);
        CLI::App command;
        int days = 0;
        std::string name;
        bool isQuiet = false;
        std::vector<std::string> packs;
        command.add_option("--days", days);
        command.add_option("--name", name);
        command.add_flag("--quiet", isQuiet);
        command.add_option("--packs", packs);
        const auto done = applySettings(file_, command, {});
        return done ? "" : done.error().message.substr(file_.string().size());
    };
    EXPECT_EQ(errorOf("days = 1\nname = 'a'\nquiet = true\npacks = []\n"), "");
    EXPECT_EQ(errorOf("days = '1'\nname = 5\nquiet = 'true'\n"), "") << "as they are written";
    EXPECT_EQ(errorOf("name = true\n"), ":1: name: expected a number or a text, not true or false");
    EXPECT_EQ(errorOf("days = [1]\n"), ":1: days: expected one value, not a list");
    EXPECT_EQ(errorOf("quiet = 1\n"), ":1: quiet: expected true or false");
    EXPECT_EQ(errorOf("name = 1979-05-27\n"), ":1: name: expected a number or a text");
    EXPECT_EQ(errorOf("\ndays = 'x'\n"), ":2: days: expected a number, got \"x\"");
}

TEST_F(Settings, AnOptionOfSeveralValuesTakesAList) {
    std::filesystem::create_directories(file_.parent_path());
    CLI::App command;
    io::WorldOptions options;
    int days = 0;
    addContentOption(command, options);
    command.add_option("--days", days);
    write("content = ['isles', 'ores']\n");
    const auto done = applySettings(file_, command, {});
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(options.content, (std::vector<std::string>{"isles", "ores"}));
    write("days = [1, 2]\n");
    const auto wrong = applySettings(file_, command, {});
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().message.find("settings.toml:1: days: "), std::string::npos)
        << wrong.error().message;
}

TEST_F(Settings, AWrongValueOfAFormerNameIsNamedWithItsLine) {
    std::filesystem::create_directories(file_.parent_path());
    write("\natmosphere = 'maybe'\n");
    CLI::App command;
    GraphicsOptions options;
    addGraphicsOptions(command, options, "low");
    const auto done = applySettings(file_, command, {"preset", "distance-fog"});
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("settings.toml:2: distance-fog: "), std::string::npos)
        << done.error().message;
}

TEST_F(Settings, AByteOrderMarkIsNoLetter) {
    std::filesystem::create_directories(file_.parent_path());
    write("\xEF\xBB\xBFmovement = 'walls'\r\nday-minutes = 3\r\n");
    ASSERT_TRUE(writeChanges(file_, {{"movement", "fly"}}, {{"movement", "fast"}}, kGraphics));
    EXPECT_EQ(written(), "\xEF\xBB\xBFmovement = 'fast'\r\nday-minutes = 3\r\n");
}

TEST_F(Settings, ALinkStaysOne) {
    std::filesystem::create_directories(file_.parent_path());
    const std::filesystem::path target = folder_ / "dotfiles.toml";
    std::filesystem::create_symlink("../dotfiles.toml", file_);
    for (const char* movement : {"fast", "walls"}) {  // the link is dangling at first
        ASSERT_TRUE(writeChanges(file_, {}, {{"movement", movement}}, kGraphics));
        EXPECT_TRUE(std::filesystem::is_symlink(file_));
        EXPECT_TRUE(std::filesystem::is_regular_file(target));
        EXPECT_EQ(lines(), (Lines{fmt::format("movement = '{}'", movement)}));
    }
}

TEST_F(Settings, NothingIsLeftOfAFileThatCannotBeWritten) {
    std::filesystem::create_directories(file_);  // a folder in its place
    EXPECT_FALSE(writeChanges(file_, {}, {{"movement", "fast"}}, kGraphics));
    EXPECT_EQ(folder_.fileCount(), 1);
    EXPECT_TRUE(std::filesystem::is_empty(file_));
}

TEST_F(Settings, AFileThatCannotBeReadStays) {
    std::filesystem::create_directories(file_.parent_path());
    write("movement = \n");
    const auto done = writeChanges(file_, {}, {{"movement", "fast"}}, kGraphics);
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("settings.toml:1: "), std::string::npos) << done.error().message;
    EXPECT_EQ(written(), "movement = \n");
}

TEST_F(Settings, NoFileTakesNothing) {
    EXPECT_TRUE(writeChanges("", {}, {{"movement", "fast"}}, kGraphics));
}

}  // namespace
}  // namespace terrane::app
