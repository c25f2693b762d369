#include "apps/terrane/output_files.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "apps/terrane/options.h"
#include "tests/base/temp_folder.h"

namespace terrane::app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A command with a world, an input, a folder that is read and two outputs.
class OutputFilesTest : public testing::Test {
  protected:
    OutputFilesTest() {
        fs::current_path(folder_.path());
        for (const char* name : {"h.sqlite", "in.toml"}) std::ofstream(name) << "content";
        fs::create_directory("pack");
        std::ofstream("pack/blocks.toml") << "content";
    }
    ~OutputFilesTest() override { fs::current_path(former_); }

    // The error of a command line; empty: there is none.
    static std::string errorOf(std::vector<std::string> arguments) {
        CLI::App command("", "test");
        io::SaveOptions save;
        std::string trace, report, input, content, tiles;
        addWorldOption(command, save, "");
        addTraceOption(command, trace);
        addReportOption(command, report);
        command.add_option("--input", input)->type_name("FILE");
        command.add_option("--content", content)->type_name("PACK");
        writesFolder(command.add_option("--tiles", tiles));
        std::ranges::reverse(arguments);
        command.parse(arguments);
        const base::Result<void> checked = checkOutputs(command);
        return checked ? "" : checked.error().message;
    }

    const fs::path former_ = fs::current_path();
    base::TempFolder folder_;
};

TEST_F(OutputFilesTest, DifferentFilesPass) {
    EXPECT_EQ(errorOf({"--world", "h.sqlite", "--trace", "t.json", "--report", "r.json", "--input", "in.toml",
                       "--content", "pack", "--tiles", "tiles"}),
              "");
    EXPECT_EQ(errorOf({"--world", "postgresql://host/name", "--trace", "name"}), "");
    EXPECT_EQ(errorOf({}), "");
}

TEST_F(OutputFilesTest, AWorldIsNoOutput) {
    EXPECT_EQ(errorOf({"--world", "h.sqlite", "--trace", "h.sqlite"}),
              "--trace: h.sqlite is also a file of --world");
    for (const char* ending : {"-wal", "-shm", "-journal", "-lock"})
        EXPECT_THAT(errorOf({"--world", "h.sqlite", "--trace", std::string("h.sqlite") + ending}),
                    HasSubstr("--world"));
    for (const char* name : {"h.server.sqlite", "h.map.sqlite-wal", "h.server.pem", "h.server.toml"})
        EXPECT_THAT(errorOf({"--world", "h.sqlite", "--report", name}), HasSubstr("--world")) << name;
    EXPECT_THAT(errorOf({"--world", "new.sqlite", "--trace", "new.sqlite"}), HasSubstr("--world"));
}

TEST_F(OutputFilesTest, LinksAndOtherSpellingsAreSeenThrough) {
    fs::create_symlink("h.sqlite", "link");
    fs::create_hard_link("h.sqlite", "hard");
    fs::create_directory_symlink(".", "here");
    for (const std::string& name :
         {std::string("link"), std::string("hard"), std::string("./pack/../h.sqlite"),
          std::string("here/h.sqlite"), fs::absolute("h.sqlite").string()}) {
        EXPECT_THAT(errorOf({"--world", "h.sqlite", "--trace", name}), HasSubstr("--world")) << name;
        EXPECT_THAT(errorOf({"--input", "h.sqlite", "--trace", name}), HasSubstr("--input")) << name;
    }
}

// Whoever's: the server's file of another world has its players and passwords.
TEST_F(OutputFilesTest, NoDatabaseOrKeyIsReplaced) {
    using std::string_literals::operator""s;
    for (const std::string& start : {"SQLite format 3\0"s, "-----BEGIN PRIVATE KEY-----\n"s}) {
        std::ofstream("other.server") << start << "and the rest";
        try {
            ADD_FAILURE() << errorOf({"--world", "h.sqlite", "--trace", "other.server"}) << " is no refusal";
        } catch (const CLI::ValidationError& refused) {
            EXPECT_THAT(refused.what(), HasSubstr("\"other.server\" is a database or a key"));
        }
    }
    std::ofstream("other.server") << "SQLite";
    EXPECT_EQ(errorOf({"--world", "h.sqlite", "--trace", "other.server"}), "");
}

TEST_F(OutputFilesTest, TwoOutputsAreTwoFiles) {
    EXPECT_THAT(errorOf({"--report", "same.json", "--trace", "./same.json"}), HasSubstr("is also a file of"));
}

TEST_F(OutputFilesTest, NoFileOfAFolderThatIsReadIsReplaced) {
    EXPECT_THAT(errorOf({"--content", "pack", "--trace", "pack/blocks.toml"}),
                HasSubstr("is a file in the folder of --content"));
    EXPECT_THAT(errorOf({"--content", "pack", "--tiles", "pack"}), HasSubstr("--content"));
    EXPECT_EQ(errorOf({"--content", "pack", "--trace", "pack.json"}), "");
    EXPECT_EQ(errorOf({"--content", "pack", "--trace", "pack/new.json"}), "") << "it replaces nothing";
}

}  // namespace
}  // namespace terrane::app
