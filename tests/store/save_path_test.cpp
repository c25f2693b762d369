#include "terrane/store/save_path.h"

#include <gmock/gmock.h>

#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

TEST(SavePath, BesideTheWorkingDirectoryInASourceTree) {
    const base::TempFolder build;
    writeAll(build / "CMakeCache.txt", "");
    const SavePlaces places{build / "terrane", "/data", "/home/me"};
    EXPECT_EQ(*savePath("world", places), "save/world.sqlite");
}

TEST(SavePath, InTheDataFolderWhenInstalled) {
    EXPECT_EQ(*savePath("world", {"/usr/bin/terrane", "/data", "/home/me"}), "/data/terrane/world.sqlite");
    const std::filesystem::path byHome = "/home/me/.local/share/terrane/world.sqlite";
    EXPECT_EQ(*savePath("world", {"/usr/bin/terrane", "", "/home/me"}), byHome);
    EXPECT_EQ(*savePath("world", {"/usr/bin/terrane", "relative", "/home/me"}), byHome);
    EXPECT_FALSE(savePath("world", {"/usr/bin/terrane", "", ""}));
}

TEST(SavePath, NamesThatAreFiles) {
    const SavePlaces places{"/usr/bin/terrane", "/data", ""};
    for (const std::string& name :
         std::vector<std::string>{"a", "My world 2", "svět", "a.b", "-x", std::string(100, 'n')})
        EXPECT_TRUE(savePath(name, places)) << name;
    for (const std::string& name : std::vector<std::string>{"", ".", "..", ".hidden", "a/b", "/etc/x", "../x",
                                                            "a\\b", "a\nb", " a", std::string(101, 'n')}) {
        EXPECT_FALSE(savePath(name, places)) << name;
    }
    EXPECT_FALSE(savePath(std::string_view("a\0b", 3), places));
    EXPECT_EQ(savePath("a\nb", places).error().message,
              "\"a\\nb\": the name of a save has neither slashes nor control characters");
}

TEST(SavePath, OfThisProgram) {
    EXPECT_EQ(savePlaces().program.filename(), "store_tests");
}

}  // namespace
}  // namespace terrane::store
