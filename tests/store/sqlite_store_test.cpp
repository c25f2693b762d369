#include "terrane/store/sqlite_store.h"

#include <gmock/gmock.h>

#include <thread>

#include "terrane/store/memory_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using namespace std::chrono_literals;
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

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

TEST_F(SqliteStoreTest, ChunksAndSettingsComeBack) {
    {
        const auto store = open();
        EXPECT_TRUE(store->isPersistent());
        EXPECT_EQ(store->load({0, 0}).state, State::Absent);
        EXPECT_FALSE(store->contains({0, 0}));
        store->save({0, 0}, numberedChunk(1), Origin::Edited);
        store->save({world::kMinChunk, world::kMaxChunk}, numberedChunk(2), Origin::Generated);
        store->save({world::kMaxChunk, world::kMinChunk}, numberedChunk(3), Origin::Edited);
        store->setSetting("player", "1,2,3");
        EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(1)) << "before it is written";
        EXPECT_TRUE(store->contains({0, 0}));
        ASSERT_TRUE(store->flush());
        EXPECT_EQ(store->status().durable, 4u);
        EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(1)) << "from the file";
    }
    EXPECT_EQ(folder_.fileCount(), 1) << "one file is left, no log and no lock";
    const auto store = open();
    EXPECT_EQ(store->identity(), kIdentity);
    EXPECT_EQ(store->setting("player"), "1,2,3");
    EXPECT_EQ(store->setting("nothing"), std::nullopt);
    const LoadedChunk corner = store->load({world::kMinChunk, world::kMaxChunk});
    ASSERT_EQ(corner.state, State::Present);
    EXPECT_EQ(*corner.chunk, *numberedChunk(2));
    EXPECT_EQ(corner.origin, Origin::Generated);
    EXPECT_EQ(*store->load({world::kMaxChunk, world::kMinChunk}).chunk, *numberedChunk(3));
    EXPECT_EQ(store->load({0, 0}).origin, Origin::Edited);
    EXPECT_EQ(store->load({0, 1}).state, State::Absent);
}

TEST_F(SqliteStoreTest, GeneratedNeverReplacesEdited) {
    const auto store = open();
    store->save({0, 0}, numberedChunk(1), Origin::Edited);
    ASSERT_TRUE(store->flush());
    store->save({0, 0}, numberedChunk(2), Origin::Generated);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(1));
    store->save({0, 0}, numberedChunk(3), Origin::Edited);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(3));
}

// Names and their ids survive builds that do not know them.
TEST_F(SqliteStoreTest, AnotherBuildsBlocks) {
    world::ChunkPtr original;
    {
        const auto store = open();
        auto chunk = std::make_shared<world::Chunk>();
        for (int id = 1; id <= 5; ++id)
            chunk->setBlock(static_cast<world::BlockIndex>(id), static_cast<world::BlockId>(id));
        original = chunk;
        store->save({0, 0}, original, Origin::Edited);
    }
    {
        const auto registry = registryOf({"lamp", "sand", "stone"});
        const auto store = open(registry);
        auto chunk = std::make_shared<world::Chunk>(*store->load({0, 0}).chunk);
        EXPECT_EQ(registry.type(chunk->block(1)).name, "stone");
        EXPECT_EQ(registry.type(chunk->block(2)).name, "missing") << "dirt";
        EXPECT_EQ(registry.type(chunk->block(4)).name, "sand");
        chunk->setBlock(100, registry.find("lamp")->id);
        store->save({0, 0}, chunk, Origin::Edited);
    }
    const auto chunk = open()->load({0, 0}).chunk;
    for (int id = 1; id <= 5; ++id) EXPECT_EQ(chunk->block(static_cast<world::BlockIndex>(id)), id);
    EXPECT_EQ(registry_.type(chunk->block(100)).name, "missing") << "the lamp";
}

TEST_F(SqliteStoreTest, DamagedRowIsPutAside) {
    {
        const auto store = open();
        store->save({0, 0}, numberedChunk(1), Origin::Edited);
        store->save({5, -6}, numberedChunk(2), Origin::Edited);
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
        store->save({5, -6}, numberedChunk(3), Origin::Edited);
        ASSERT_TRUE(store->flush());
        EXPECT_EQ(*store->load({5, -6}).chunk, *numberedChunk(3));
    }
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine" + where), 1);
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM chunks"), 2);
    EXPECT_EQ(queryFile(path_, "SELECT length(data) > 21 AND substr(data, 21, 1) = x'00' FROM quarantine"),
              1);
}

// Whoever saves without having loaded does not overwrite what could still be rescued.
TEST_F(SqliteStoreTest, DamagedRowIsPutAsideAlsoWhenNobodyLooked) {
    { open()->save({0, 0}, numberedChunk(1), Origin::Edited); }
    runSql(path_, "UPDATE chunks SET data = x'0102'");
    { open()->save({0, 0}, numberedChunk(2), Origin::Edited); }
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine WHERE data = x'0102'"), 1);
    EXPECT_EQ(*open()->load({0, 0}).chunk, *numberedChunk(2));
}

TEST_F(SqliteStoreTest, ARowWithoutBytesIsPutAsideAndReplaced) {
    {
        const auto store = open();
        for (int x = 0; x < 2; ++x) store->save({x, 0}, numberedChunk(1), Origin::Edited);
    }
    runSql(path_, "UPDATE chunks SET data = x''");
    {
        const auto store = open();
        EXPECT_EQ(store->load({0, 0}).state, State::Damaged);
        for (int x = 0; x < 2; ++x) store->save({x, 0}, numberedChunk(2), Origin::Generated);
    }
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine WHERE data = x''"), 2);
    const auto store = open();
    for (int x = 0; x < 2; ++x) {
        const LoadedChunk loaded = store->load({x, 0});
        ASSERT_EQ(loaded.state, State::Present);
        EXPECT_EQ(*loaded.chunk, *numberedChunk(2));
    }
}

TEST_F(SqliteStoreTest, TheIdentityIsNoSettingToBeSet) {
    const auto trySetting = [](ChunkStore& store) {
        for (const char* name : {"seed", "generator", "generator_version"}) store.setSetting(name, "x");
        EXPECT_EQ(store.status().queued, 0u);
        EXPECT_EQ(store.identity(), kIdentity);
    };
    trySetting(*open());
    EXPECT_EQ(open()->identity(), kIdentity);
    MemoryStore inMemory(kIdentity);
    trySetting(inMemory);
    EXPECT_FALSE(inMemory.setting("seed"));
}

TEST_F(SqliteStoreTest, IdWithoutANameIsDamage) {
    { open()->save({0, 0}, numberedChunk(1), Origin::Edited); }
    runSql(path_, "DELETE FROM blocks WHERE name = 'dirt'");
    // The id goes to the next type that needs one, so the name has to be gone from the registry too.
    const auto store = open(registryOf({"stone", "grass", "sand", "water"}));
    EXPECT_THAT(store->load({0, 0}).problem, HasSubstr("block id 2 has no name"));
}

TEST_F(SqliteStoreTest, WhatNoSaveHoldsIsLeftOut) {
    const auto store = open();
    auto chunk = std::make_shared<world::Chunk>();
    chunk->setLargeData(0, world::LargeData(70u << 20));
    store->save({0, 0}, chunk, Origin::Edited);
    store->save({1, 0}, numberedChunk(1), Origin::Edited);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(store->load({0, 0}).state, State::Absent);
    EXPECT_EQ(store->load({1, 0}).state, State::Present);
}

TEST_F(SqliteStoreTest, LoadsAndSavesFromManyThreads) {
    const auto store = open();
    constexpr int kChunks = 200;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < kChunks; ++i) {
                store->save({i, t}, numberedChunk(i * 4 + t), Origin::Edited);
                if (i % 60 == t && !store->flush()) ADD_FAILURE() << "flush";
                const auto seen = store->load({i / 2, t}).chunk;
                if (!seen || *seen != *numberedChunk(i / 2 * 4 + t)) ADD_FAILURE() << i << " " << t;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM chunks"), 4 * kChunks);
}

}  // namespace
}  // namespace terrane::store
