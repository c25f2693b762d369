#include "terrane/store/sqlite/sqlite_store.h"

#include <gmock/gmock.h>

#include "terrane/store/chunks/chunk_key.h"
#include "tests/store/faulty_disk.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;
using State = LoadedChunk::State;

class SqliteStoreTest : public testing::Test {
  protected:
    std::unique_ptr<SqliteStore> open(const world::BlockRegistry& registry) {
        auto store = SqliteStore::open(path_, registry, {.create = kIdentity, .decide = {}}, kNever);
        if (!store) throw std::runtime_error(store.error().message);
        return std::move(*store);
    }
    std::unique_ptr<SqliteStore> open() { return open(registry_); }
    // The data of the only row.
    Bytes chunkData(const std::string& table = "chunks") {
        auto database = Database::open(path_, OpenMode::ReadOnly).value();
        auto select = database.prepare("SELECT data FROM " + table).value();
        EXPECT_TRUE(select.step().value());
        const ByteView data = select.blob(0);
        return Bytes(data.begin(), data.end());
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

TEST_F(SqliteStoreTest, LeavesOneFile) {
    {
        const auto store = open();
        EXPECT_TRUE(store->isPersistent());
        store->save({0, 0}, numberedChunk(1), Provenance::Edited);
        store->setMetadata("player", "1,2,3");
        EXPECT_EQ(store->status().waiting, 1u);
        ASSERT_TRUE(store->flush());
    }
    EXPECT_EQ(folder_.fileCount(), 1) << "no log and no lock";
    EXPECT_EQ(queryFile(path_, "SELECT value FROM settings WHERE name = 'player'"), 1) << "1,2,3 as a number";
    EXPECT_EQ(queryFile(path_, "SELECT origin FROM chunks"), 1);
}

// Names and their ids survive builds that lack them.
TEST_F(SqliteStoreTest, AnotherBuildsBlocks) {
    world::ChunkPtr original;
    {
        const auto store = open();
        auto chunk = std::make_shared<world::Chunk>();
        for (int id = 1; id <= 5; ++id)
            chunk->setBlock(static_cast<world::BlockIndex>(id), static_cast<world::BlockId>(id));
        original = chunk;
        store->save({0, 0}, original, Provenance::Edited);
    }
    {
        const auto registry = registryOf({"lamp", "sand", "stone"});
        const auto store = open(registry);
        auto chunk = std::make_shared<world::Chunk>(*store->load({0, 0}).chunk);
        EXPECT_EQ(registry.type(chunk->block(1)).name, "stone");
        EXPECT_EQ(registry.type(chunk->block(2)).name, "missing") << "dirt";
        EXPECT_EQ(registry.type(chunk->block(4)).name, "sand");
        chunk->setBlock(100, registry.find("lamp")->id);
        store->save({0, 0}, chunk, Provenance::Edited);
    }
    const auto chunk = open()->load({0, 0}).chunk;
    for (int id = 1; id <= 5; ++id) EXPECT_EQ(chunk->block(static_cast<world::BlockIndex>(id)), id);
    EXPECT_EQ(registry_.type(chunk->block(100)).name, "missing") << "the lamp";
}

TEST_F(SqliteStoreTest, DamagedRowIsQuarantined) {
    {
        const auto store = open();
        store->save({0, 0}, numberedChunk(1), Provenance::Edited);
        store->save({5, -6}, numberedChunk(2), Provenance::Edited);
    }
    const std::string where = fmt::format(" WHERE key = {}", keyOf({5, -6}));
    runSql(path_,
           "UPDATE chunks SET data = CAST(substr(data, 1, 20) || x'00' || substr(data, 22) AS BLOB)" + where);
    {
        const auto store = open();
        const LoadedChunk damaged = store->load({5, -6});
        EXPECT_EQ(damaged.state, State::Damaged);
        EXPECT_EQ(damaged.chunk, nullptr);
        EXPECT_THAT(damaged.problem, HasSubstr("a.sqlite: chunk 5,-6: the checksum is wrong"));
        EXPECT_EQ(store->load({0, 0}).state, State::Present);
        store->save({5, -6}, numberedChunk(3), Provenance::Edited);
        ASSERT_TRUE(store->flush());
        EXPECT_EQ(*store->load({5, -6}).chunk, *numberedChunk(3));
    }
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine" + where), 1);
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM chunks"), 2);
    EXPECT_EQ(queryFile(path_, "SELECT length(data) > 21 AND substr(data, 21, 1) = x'00' FROM quarantine"),
              1);
}

// After a temporary read failure, the generated chunk does not overwrite the stored one.
TEST_F(SqliteStoreTest, WhatCouldNotBeReadIsNotSavedOver) {
    FaultyDisk disk;
    { open()->save({0, 0}, numberedChunk(1), Provenance::Edited); }
    const auto store = open();
    disk.fail(kDiskRead);
    EXPECT_EQ(store->load({0, 0}).state, State::Damaged);
    disk.work();
    store->save({0, 0}, numberedChunk(2), Provenance::Generated);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(1));
}

// If a player edits the chunk, the unreadable row is quarantined first, once.
TEST_F(SqliteStoreTest, WhatCouldNotBeReadIsQuarantinedBeforeItIsReplaced) {
    FaultyDisk disk;
    { open()->save({0, 0}, numberedChunk(1), Provenance::Edited); }
    const Bytes before = chunkData();
    {
        const auto store = open();
        disk.fail(kDiskRead);
        EXPECT_EQ(store->load({0, 0}).state, State::Damaged);
        disk.work();
        for (const int number : {2, 3}) {
            store->save({0, 0}, numberedChunk(number), Provenance::Edited);
            disk.fail(kDiskSync);
            EXPECT_FALSE(store->flush()) << "the disk fails again";
            disk.work();
            ASSERT_TRUE(store->flush());
        }
    }
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine"), 1);
    EXPECT_EQ(chunkData("quarantine"), before);
    EXPECT_EQ(*open()->load({0, 0}).chunk, *numberedChunk(3));
}

// Saving without loading does not overwrite data that could still be recovered.
TEST_F(SqliteStoreTest, DamagedRowIsQuarantinedAlsoWhenNobodyLooked) {
    { open()->save({0, 0}, numberedChunk(1), Provenance::Edited); }
    runSql(path_, "UPDATE chunks SET data = x'0102'");
    { open()->save({0, 0}, numberedChunk(2), Provenance::Edited); }
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine WHERE data = x'0102'"), 1);
    EXPECT_EQ(*open()->load({0, 0}).chunk, *numberedChunk(2));
}

TEST_F(SqliteStoreTest, ARowWithoutBytesIsQuarantinedAndReplaced) {
    {
        const auto store = open();
        for (int x = 0; x < 2; ++x) store->save({x, 0}, numberedChunk(1), Provenance::Edited);
    }
    runSql(path_, "UPDATE chunks SET data = x''");
    {
        const auto store = open();
        EXPECT_EQ(store->load({0, 0}).state, State::Damaged);
        for (int x = 0; x < 2; ++x) store->save({x, 0}, numberedChunk(2), Provenance::Generated);
    }
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine WHERE data = x''"), 2);
    const auto store = open();
    for (int x = 0; x < 2; ++x) {
        const LoadedChunk loaded = store->load({x, 0});
        ASSERT_EQ(loaded.state, State::Present);
        EXPECT_EQ(*loaded.chunk, *numberedChunk(2));
    }
}

// Such a row is damaged. It must not remain after an edit was reported as saved.
TEST_F(SqliteStoreTest, AnEditReplacesARowOfAnyOrigin) {
    for (const char* origin : {"2", "143", "-1", "'abc'"}) {
        open()->save({0, 0}, numberedChunk(1), Provenance::Edited);
        runSql(path_, std::string("UPDATE chunks SET origin = ") + origin);
        open()->save({0, 0}, numberedChunk(3), Provenance::Edited);
        EXPECT_TRUE(*open()->load({0, 0}).chunk == *numberedChunk(3)) << origin;
    }
}

TEST_F(SqliteStoreTest, TheIdentityIsNotOverwritten) {
    { open()->setMetadata("seed", "x"); }
    EXPECT_EQ(open()->identity(), kIdentity);
}

// Damage in one row does not affect the others of a batch.
TEST_F(SqliteStoreTest, LoadsManyAroundDamagedRows) {
    std::vector<world::ChunkPos> positions;
    {
        const auto store = open();
        for (int x = 0; x < 10; ++x) {
            positions.push_back({x, 1});
            store->save({x, 1}, numberedChunk(x), Provenance::Edited);
        }
    }
    runSql(path_, fmt::format("UPDATE chunks SET data = zeroblob(60) WHERE key = {}", keyOf({4, 1})));
    const auto store = open();
    const auto many = store->loadMany(positions);
    for (int x = 0; x < 10; ++x) {
        const LoadedChunk& loaded = many[static_cast<std::size_t>(x)];
        ASSERT_EQ(loaded.state, x == 4 ? State::Damaged : State::Present) << x;
        if (loaded.chunk) {
            EXPECT_EQ(*loaded.chunk, *numberedChunk(x));
        }
    }
    EXPECT_THAT(many[4].problem, HasSubstr("a.sqlite: chunk 4,1: the checksum is wrong"));
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine WHERE reason = 'the checksum is wrong'"), 1);
    EXPECT_EQ(store->load({4, 1}).state, State::Absent);
}

TEST_F(SqliteStoreTest, DamageOfAHigherLevelIsNamed) {
    { open()->save({5, -6, 2}, numberedChunk(1), Provenance::Edited); }
    runSql(path_, "UPDATE chunks SET data = zeroblob(60)");
    const auto store = open();
    EXPECT_EQ(store->load({5, -6}).state, State::Absent);
    EXPECT_THAT(store->load({5, -6, 2}).problem, HasSubstr("a.sqlite: chunk 5,-6 of level 2: the checksum"));
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(
        queryFile(path_, fmt::format("SELECT count(*) FROM quarantine WHERE key = {}", keyOf({5, -6, 2}))),
        1);
}

TEST_F(SqliteStoreTest, IdWithoutANameIsDamage) {
    { open()->save({0, 0}, numberedChunk(1), Provenance::Edited); }
    runSql(path_,
           "DELETE FROM blocks WHERE name = 'dirt'; UPDATE settings SET value = '' WHERE name = 'checksum'");
    // The id goes to the next new type, so the registry must lack the name, too.
    const auto store = open(registryOf({"stone", "grass", "sand", "water"}));
    EXPECT_THAT(store->load({0, 0}).problem, HasSubstr("block id 2 has no name"));
}

TEST_F(SqliteStoreTest, WhatNoSaveHoldsIsLeftOut) {
    const auto store = open();
    auto chunk = std::make_shared<world::Chunk>();
    chunk->setBlockEntityData(0, world::BlockEntityData(70u << 20));
    store->save({0, 0}, chunk, Provenance::Edited);
    store->save({1, 0}, numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(store->load({0, 0}).state, State::Absent);
    EXPECT_EQ(store->load({1, 0}).state, State::Present);
}

// Writing into a deleted file would look like a successful save.
TEST_F(SqliteStoreTest, AMovedOrReplacedFileIsNotWritten) {
    const auto elsewhere = folder_ / "elsewhere";
    for (const char* ending : {"", "-wal"}) {
        const std::filesystem::path file = path_.string() + ending;
        const auto store = open();
        store->save({0, 0}, numberedChunk(1), Provenance::Edited);
        ASSERT_TRUE(store->flush());
        std::filesystem::rename(file, elsewhere);
        store->save({0, 0}, numberedChunk(2), Provenance::Edited);
        const auto moved = store->flush();
        ASSERT_FALSE(moved) << ending;
        EXPECT_THAT(moved.error().message, HasSubstr(file.string() + ": deleted or moved while it was open"));
        writeAll(file, "another");
        const auto replaced = store->flush();
        ASSERT_FALSE(replaced) << ending;
        EXPECT_THAT(replaced.error().message, HasSubstr(file.string() + ": replaced while it was open"));
        EXPECT_EQ(store->status().waiting, 1u);
        EXPECT_GT(store->status().failingSeconds, 0);

        std::filesystem::rename(elsewhere, file);
        EXPECT_TRUE(store->flush());
        EXPECT_EQ(store->status().failingSeconds, 0);
        EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(2));
    }
    EXPECT_EQ(*open()->load({0, 0}).chunk, *numberedChunk(2));
}

// Each attempt to write meets the damaged row again.
TEST_F(SqliteStoreTest, MessagesAboutRowsAreToldOnceTheyAreWritten) {
    { open()->save({0, 0}, numberedChunk(1), Provenance::Edited); }
    runSql(path_, "UPDATE chunks SET data = x'0102'");
    const std::filesystem::path elsewhere = folder_ / "elsewhere";
    const auto store = open();
    std::filesystem::rename(path_, elsewhere);
    store->save({0, 0}, numberedChunk(2), Provenance::Edited);
    testing::internal::CaptureStderr();
    for (int k = 0; k < 5; ++k) EXPECT_FALSE(store->flush());
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "flush() returns the reason";
    std::filesystem::rename(elsewhere, path_);
    testing::internal::CaptureStderr();
    EXPECT_TRUE(store->flush());
    const std::string log = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::ranges::count(log, '\n'), 1) << log;
    EXPECT_THAT(log, HasSubstr("its old data is kept in the table quarantine"));
}

}  // namespace
}  // namespace terrane::store
