#include "terrane/store/saves/save_path.h"

#include <gmock/gmock.h>

#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

TEST(SavePath, InTheDataFolder) {
    const std::filesystem::path data = "/data";
    EXPECT_EQ(*savePath("world", {data}), data / "terrane" / "world.sqlite");
    EXPECT_EQ(*dataFolder({data}), data / "terrane");
    const auto nowhere = savePath("world", {""});
    ASSERT_FALSE(nowhere);
    EXPECT_THAT(nowhere.error().message, testing::HasSubstr("\"world\": no folder for worlds"));
}

// Up to version 0.1 saves were below the working directory.
TEST(SavePath, InTheFormerFolderWhereOnlyThatHasIt) {
    const base::TempFolder folder;
    const std::filesystem::path former = folder / "save", data = folder / "data";
    std::filesystem::create_directories(former);
    std::filesystem::create_directories(data / "terrane");
    const SaveEnvironment places{data, former};
    EXPECT_EQ(*savePath("home", places), data / "terrane/home.sqlite");
    writeAll(former / "home.sqlite", "");
    EXPECT_EQ(*savePath("home", places), former / "home.sqlite");
    writeAll(data / "terrane/home.sqlite", "");
    EXPECT_EQ(*savePath("home", places), data / "terrane/home.sqlite");
}

TEST(SavePath, NamesThatAreFiles) {
    const SaveEnvironment places{"/data"};
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

// A server's password and claims are in a file that the world's file names.
TEST(SavePath, ALinkIsTheFileThatItLeadsTo) {
    const base::TempFolder folder;
    const auto real = std::filesystem::canonical(folder.path()) / "real.sqlite",
               link = folder / "link.sqlite";
    std::filesystem::create_symlink("real.sqlite", link);
    EXPECT_EQ(fileOf(worldLocation(link.string())).value(), link) << "it leads nowhere";
    std::ofstream(real) << "a world";
    EXPECT_EQ(fileOf(worldLocation(link.string())).value(), real);
    EXPECT_EQ(fileOf(worldLocation(real.string())).value(), real);
}

TEST(SavePath, NewNamesFollowTheRule) {
    const base::TempFolder folder;
    const SaveEnvironment places{folder.path()};
    const std::filesystem::path worlds = folder / "terrane";
    for (const char* bad : {"w\u200b", "\u3164", "\u0391nn", "\xff", "a  b", "a "})
        EXPECT_FALSE(savePath(bad, places)) << bad;
    EXPECT_EQ(*savePath("cafe\u0301", places), worlds / "caf\u00e9.sqlite") << "its normal form";
    std::filesystem::create_directories(worlds);
    writeAll(worlds / "Ian.sqlite", "");
    EXPECT_EQ(savePath("lan", places).error().message,
              "\"lan\": there is no such world, and a new one cannot have a name that looks like \"Ian\"");
    EXPECT_TRUE(savePath("Jan", places));
}

// Saves that have such a name from before the rule still open.
TEST(SavePath, OldNamesStay) {
    const base::TempFolder folder;
    const SaveEnvironment places{folder.path()};
    const std::filesystem::path worlds = folder / "terrane";
    std::filesystem::create_directories(worlds);
    for (const char* old : {"w\u200b", "\u3164", "w", "W", "cafe\u0301", "a "}) {
        writeAll(worlds / (std::string(old) + ".sqlite"), "");
        EXPECT_EQ(*savePath(old, places), worlds / (std::string(old) + ".sqlite")) << old;
    }
}

}  // namespace
}  // namespace terrane::store
