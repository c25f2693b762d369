#include "terrane/store/saves/world_list.h"

#include <gmock/gmock.h>

#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

namespace fs = std::filesystem;
using base::ErrorCode;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class WorldList : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }

    std::unique_ptr<SqliteStore> open(const std::string& name) {
        auto store =
            SqliteStore::open(worldFile(folder_, name), blocks_, {.create = kIdentity, .decide = {}});
        if (!store) throw std::runtime_error(store.error().message);
        return std::move(*store);
    }
    void make(const std::string& name, int number = 1) {
        const auto store = open(name);
        store->save({0, 0}, numberedChunk(number), {});
        store->setMetadata("camera", "1 2 3 4 5");
        writeAll(thumbnailOf(worldFile(folder_, name)), "picture of " + name);
    }
    std::int64_t chunksOf(const std::string& name) {
        return queryFile(worldFile(folder_, name), "SELECT count(*) FROM chunks");
    }
    std::vector<std::string> names() {
        std::vector<std::string> found;
        for (const WorldEntry& entry : listWorlds(folder_, blocks_)) found.push_back(entry.name);
        std::ranges::sort(found);
        return found;
    }
    std::vector<std::string> files() {
        std::vector<std::string> found;
        for (const auto& file : fs::directory_iterator(folder_)) found.push_back(file.path().filename());
        std::ranges::sort(found);
        return found;
    }
    WorldEntry entry(const std::string& name) {
        for (WorldEntry& entry : listWorlds(folder_, blocks_))
            if (entry.name == name) return entry;
        throw std::runtime_error("no such world: " + name);
    }
    static ErrorCode codeOf(const base::Result<void>& result) {
        return result ? ErrorCode::Failed : result.error().code;
    }
    base::Result<void> copy(const std::string& name, const std::string& newName,
                            const CopyProgress& progress = {}) {
        return copySave(folder_, {name, newName}, blocks_, progress);
    }

    base::TempFolder temporary_;
    fs::path folder_ = temporary_.path() / "worlds";
    world::BlockRegistry blocks_ = testRegistry();
};

TEST_F(WorldList, AFolderThatIsNotThereHasNoWorlds) {
    EXPECT_THAT(listWorlds(folder_ / "none", blocks_), IsEmpty());
    EXPECT_THAT(listWorlds(folder_, blocks_), IsEmpty());
}

TEST_F(WorldList, TellsOfEachWorld) {
    make("home");
    const WorldEntry home = entry("home");
    EXPECT_EQ(home.identity, kIdentity);
    EXPECT_EQ(home.path, folder_ / "home.sqlite");
    EXPECT_EQ(home.sizeBytes, fs::file_size(home.path));
    EXPECT_EQ(home.lastPlayed, fs::last_write_time(home.path));
    EXPECT_EQ(home.metadata.at("camera"), "1 2 3 4 5");
    EXPECT_EQ(home.problem, "");
    EXPECT_EQ(home.inUse, "");
}

TEST_F(WorldList, TheLastPlayedComesFirst) {
    for (const char* name : {"a", "b", "c"}) make(name);
    const auto now = fs::last_write_time(folder_ / "a.sqlite");
    fs::last_write_time(folder_ / "b.sqlite", now + std::chrono::hours(1));
    fs::last_write_time(folder_ / "c.sqlite", now - std::chrono::hours(1));
    std::vector<std::string> order;
    for (const WorldEntry& entry : listWorlds(folder_, blocks_)) order.push_back(entry.name);
    EXPECT_THAT(order, ElementsAre("b", "a", "c"));
}

// The order of a folder is arbitrary: the one that was played last must not depend on it.
TEST_F(WorldList, AFullFolderListsTheWorldsThatWerePlayedLast) {
    const auto now = fs::file_time_type::clock::now();
    for (std::size_t k = 0; k < kMaxListedWorlds + 20; ++k) {
        const fs::path file = folder_ / fmt::format("w{:04}.sqlite", k * 7 % (kMaxListedWorlds + 20));
        writeAll(file, "x");
        fs::last_write_time(file, now - std::chrono::seconds(k));
    }
    const std::vector<WorldEntry> worlds = listWorlds(folder_, blocks_);
    ASSERT_EQ(worlds.size(), kMaxListedWorlds);
    EXPECT_EQ(worlds.front().name, "w0000");
    EXPECT_EQ(worlds.back().lastPlayed, now - std::chrono::seconds(kMaxListedWorlds - 1));
}

TEST_F(WorldList, WhatIsNoWorldIsListedWithTheReason) {
    make("home");
    make("cut");
    fs::resize_file(folder_ / "cut.sqlite", fs::file_size(folder_ / "cut.sqlite") / 2);
    writeAll(folder_ / "text.sqlite", "this is no save");
    writeAll(folder_ / "empty.sqlite", "");
    runSql(folder_ / "foreign.sqlite", "CREATE TABLE photos(name TEXT)");
    fs::create_symlink(folder_ / "nowhere", folder_ / "broken.sqlite");
    fs::create_directory(folder_ / "folder.sqlite");
    writeAll(folder_ / "notes.txt", "no world");
    EXPECT_THAT(names(), ElementsAre("broken", "cut", "empty", "foreign", "home", "text"));
    EXPECT_THAT(entry("cut").problem, HasSubstr("cut off"));
    EXPECT_EQ(entry("text").problem, "not a save: not a SQLite file");
    EXPECT_EQ(entry("empty").problem, "empty, not a save");
    EXPECT_NE(entry("foreign").problem, "");
    EXPECT_NE(entry("broken").problem, "");
    EXPECT_EQ(entry("home").problem, "");
    for (const WorldEntry& entry : listWorlds(folder_, blocks_))
        EXPECT_EQ(entry.problem.find('\n'), std::string::npos);
}

TEST_F(WorldList, AWorldThatIsPlayedIsReadAndLeftAsItIs) {
    make("home");
    const auto player = open("home");
    player->save({1, 0}, numberedChunk(2), {});
    ASSERT_TRUE(player->flush());
    EXPECT_THAT(entry("home").inUse, HasSubstr("open in another program"));
    EXPECT_GT(entry("home").sizeBytes, fs::file_size(folder_ / "home.sqlite"));  // the log is included
    EXPECT_EQ(codeOf(renameWorld(folder_, "home", "other")), ErrorCode::Busy);
    EXPECT_EQ(codeOf(deleteWorld(folder_, "home")), ErrorCode::Busy);
    ASSERT_TRUE(copy("home", "other"));
    EXPECT_EQ(chunksOf("other"), 2);
    EXPECT_THAT(names(), ElementsAre("home", "other"));
}

TEST_F(WorldList, RenamesAWorldWithItsPicture) {
    make("home");
    ASSERT_TRUE(renameWorld(folder_, "home", "My house"));
    EXPECT_THAT(files(), ElementsAre("My house.png", "My house.sqlite"));
    EXPECT_EQ(readAll(folder_ / "My house.png"), "picture of home");
    EXPECT_EQ(chunksOf("My house"), 1);
    EXPECT_TRUE(renameWorld(folder_, "My house", "My house"));
}

// A killed program leaves its last saves in the log.
TEST_F(WorldList, TheLogOfAKilledProgramGoesWithTheWorld) {
    make("home");
    {
        const auto player = open("home");
        player->save({1, 0}, numberedChunk(2), {});
        ASSERT_TRUE(player->flush());
        for (const char* ending : {"", "-wal"})
            fs::copy_file(folder_ / ("home.sqlite" + std::string(ending)),
                          folder_ / ("killed.sqlite" + std::string(ending)));
    }
    ASSERT_TRUE(renameWorld(folder_, "killed", "found"));
    EXPECT_EQ(chunksOf("found"), 2);
    EXPECT_FALSE(fs::exists(folder_ / "killed.sqlite-wal"));
    EXPECT_THAT(names(), ElementsAre("found", "home"));
}

TEST_F(WorldList, NeverReplacesAWorld) {
    make("a", 1);
    make("b", 2);
    EXPECT_EQ(codeOf(renameWorld(folder_, "a", "b")), ErrorCode::BadInput);
    EXPECT_EQ(codeOf(copy("a", "b")), ErrorCode::BadInput);
    EXPECT_EQ(readAll(folder_ / "b.png"), "picture of b");
    // Nor adopts a log that another world left behind.
    writeAll(folder_ / "c.sqlite-wal", "left");
    EXPECT_EQ(codeOf(renameWorld(folder_, "a", "c")), ErrorCode::BadInput);
    EXPECT_EQ(codeOf(copy("a", "c")), ErrorCode::BadInput);
    EXPECT_THAT(names(), ElementsAre("a", "b"));
}

TEST_F(WorldList, HostileNamesAreRefused) {
    make("home");
    writeAll(temporary_.path() / "x.sqlite", "outside");
    const std::vector<std::string> bad = {"",
                                          "../x",
                                          "/etc/passwd",
                                          "a/b",
                                          "a\\b",
                                          ".hidden",
                                          " space",
                                          "a\nb",
                                          std::string("a\0b", 3),
                                          std::string(101, 'a')};
    for (const std::string& name : bad) {
        EXPECT_EQ(codeOf(renameWorld(folder_, "home", name)), ErrorCode::BadInput) << name;
        EXPECT_EQ(codeOf(copy("home", name)), ErrorCode::BadInput) << name;
        EXPECT_EQ(codeOf(copy(name, "copy")), ErrorCode::BadInput) << name;
        EXPECT_EQ(codeOf(renameWorld(folder_, name, "new")), ErrorCode::BadInput) << name;
        EXPECT_EQ(codeOf(deleteWorld(folder_, name)), ErrorCode::BadInput) << name;
    }
    for (const char* name : {"a.sqlite", "a ", "a."})
        EXPECT_EQ(codeOf(renameWorld(folder_, "home", name)), ErrorCode::BadInput) << name;
    EXPECT_EQ(readAll(temporary_.path() / "x.sqlite"), "outside");
    EXPECT_THAT(names(), ElementsAre("home"));
    EXPECT_TRUE(renameWorld(folder_, "home", std::string(100, 'a')));
}

TEST_F(WorldList, LinksAreLeftAlone) {
    make("home");
    fs::rename(folder_ / "home.sqlite", temporary_.path() / "elsewhere.sqlite");
    fs::create_symlink(temporary_.path() / "elsewhere.sqlite", folder_ / "link.sqlite");
    EXPECT_EQ(entry("link").problem, "");
    EXPECT_EQ(codeOf(deleteWorld(folder_, "link")), ErrorCode::Incompatible);
    EXPECT_EQ(codeOf(renameWorld(folder_, "link", "other")), ErrorCode::Incompatible);
    EXPECT_TRUE(fs::exists(temporary_.path() / "elsewhere.sqlite"));
    EXPECT_TRUE(copy("link", "copy"));
    EXPECT_EQ(chunksOf("copy"), 1);
}

TEST_F(WorldList, ACopyIsAWorldOfItsOwn) {
    make("home");
    ASSERT_TRUE(copy("home", "copy", [](double) { return true; }));
    EXPECT_EQ(entry("copy").identity, kIdentity);
    EXPECT_EQ(readAll(folder_ / "copy.png"), "picture of home");
    { open("copy")->save({5, 5}, numberedChunk(3), {}); }
    EXPECT_EQ(chunksOf("copy"), 2);
    EXPECT_EQ(chunksOf("home"), 1);
    EXPECT_EQ(codeOf(copy("none", "other")), ErrorCode::NotFound);
}

TEST_F(WorldList, ACancelledCopyLeavesNothing) {
    {
        const auto store = open("large");
        store->setMetadata("large", std::string(6 << 20, 'x'));
    }
    ASSERT_GT(fs::file_size(folder_ / "large.sqlite"), 5u << 20);
    int calls = 0;
    EXPECT_FALSE(copy("large", "copy", [&](double) { return ++calls < 1; }));
    EXPECT_EQ(calls, 1);
    EXPECT_THAT(files(), ElementsAre("large.sqlite"));
}

TEST_F(WorldList, DeletesAWorldAndWhatIsBesideIt) {
    make("home");
    make("other");
    ASSERT_TRUE(deleteWorld(folder_, "home"));
    EXPECT_THAT(files(), ElementsAre("other.png", "other.sqlite"));
    EXPECT_EQ(codeOf(deleteWorld(folder_, "home")), ErrorCode::NotFound);
    writeAll(folder_ / "bad.sqlite", "no save");
    EXPECT_TRUE(deleteWorld(folder_, "bad"));
}

TEST_F(WorldList, WhatAServerKeepsIsNoWorldAndGoesWithTheWorld) {
    make("home");
    const auto write = [&](const std::string& name) {
        runSql(folder_ / (name + ".server.sqlite"), "CREATE TABLE people(name TEXT)");
        runSql(folder_ / (name + ".map.sqlite"), "CREATE TABLE surfaces(data BLOB)");
        writeAll(folder_ / (name + ".server.pem"), "key");
        writeAll(folder_ / (name + ".server.toml"), "port = 1");
    };
    write("home");
    EXPECT_THAT(names(), ElementsAre("home"));
    EXPECT_EQ(codeOf(deleteWorld(folder_, "home.server")), ErrorCode::NotFound);

    ASSERT_TRUE(renameWorld(folder_, "home", "town"));
    EXPECT_THAT(files(), ElementsAre("town.map.sqlite", "town.png", "town.server.pem", "town.server.sqlite",
                                     "town.server.toml", "town.sqlite"));
    ASSERT_TRUE(deleteWorld(folder_, "town"));
    EXPECT_THAT(files(), ElementsAre("town.server.pem", "town.server.toml"));

    make("other");
    write("town");
    EXPECT_EQ(codeOf(renameWorld(folder_, "other", "town")), ErrorCode::BadInput) << "of another world";
    EXPECT_EQ(codeOf(checkNewWorld(folder_, "town")), ErrorCode::BadInput);
    EXPECT_EQ(unusedWorldName(folder_, "town"), "town 2");
    EXPECT_EQ(codeOf(copy("other", "third.server")), ErrorCode::BadInput);
    // Without their world they are listed, and can be deleted.
    EXPECT_THAT(names(), ElementsAre("other", "town.map", "town.server"));
    for (const char* name : {"town.map", "town.server"}) EXPECT_TRUE(deleteWorld(folder_, name));
    EXPECT_TRUE(renameWorld(folder_, "other", "town")) << "nothing is in the way";
    EXPECT_THAT(names(), ElementsAre("town"));
}

TEST_F(WorldList, AServerThatRunsKeepsItsFiles) {
    make("home");
    runSql(folder_ / "home.server.sqlite", "CREATE TABLE people(name TEXT)");
    const auto lock = FileLock::acquire(folder_ / "home.server.sqlite", FileLock::Kind::Exclusive);
    ASSERT_TRUE(lock);
    EXPECT_EQ(codeOf(renameWorld(folder_, "home", "town")), ErrorCode::Busy);
    EXPECT_EQ(codeOf(deleteWorld(folder_, "home")), ErrorCode::Busy);
    EXPECT_TRUE(fs::exists(folder_ / "home.sqlite") && fs::exists(folder_ / "home.server.sqlite"));
}

TEST_F(WorldList, NamesThatLookAlikeAreRefused) {
    make("Ian");
    make("old\u200b");
    for (const char* name : {"lan", "IAN", "Ian\u200b", "\u0406an", "\u3164", "cafe\u0301"}) {
        EXPECT_EQ(codeOf(checkNewWorld(folder_, name)), ErrorCode::BadInput) << name;
        EXPECT_EQ(codeOf(renameWorld(folder_, "old\u200b", name)), ErrorCode::BadInput) << name;
    }
    EXPECT_EQ(codeOf(checkNewWorld(folder_, "old")), ErrorCode::BadInput);
    EXPECT_TRUE(renameWorld(folder_, "old\u200b", "old"));
    EXPECT_EQ(checkNewWorld(folder_, "lan").error().message,
              "\"lan\" looks like the name of the world \"Ian\"");
    EXPECT_TRUE(renameWorld(folder_, "Ian", "IAN")) << "like its own name";
    EXPECT_EQ(unusedWorldName(folder_, "ian"), "ian 2");
    EXPECT_TRUE(checkWorldName("\u0421\u0432\u0456\u0442 2"));
}

TEST_F(WorldList, ProposesAFreeName) {
    EXPECT_EQ(unusedWorldName(folder_, "World"), "World");
    make("World");
    EXPECT_EQ(unusedWorldName(folder_, "World"), "World 2");
    make("World 2");
    EXPECT_EQ(unusedWorldName(folder_, "World"), "World 3");
    std::string longName;
    while (longName.size() < 100) longName += "ř";
    const std::string free = unusedWorldName(folder_, longName);
    EXPECT_EQ(free, longName.substr(0, 88));
    EXPECT_TRUE(checkWorldName(free));
}

}  // namespace
}  // namespace terrane::store
