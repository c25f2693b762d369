#include "tests/store/chunk_store_contract.h"
#include "tests/support/default_heights.h"

#include <gmock/gmock.h>

#include <thread>

namespace terrane::store {
namespace {

using State = LoadedChunk::State;
using world::ChunkPos;

TEST_P(ChunkStoreContract, ANewWorldIsEmpty) {
    const auto store = world_->open();
    EXPECT_EQ(store->identity(), kIdentity);
    EXPECT_EQ(store->load({0, 0}).state, State::Absent);
    EXPECT_EQ(store->load({0, 0}).chunk, nullptr);
    EXPECT_FALSE(store->contains({0, 0}));
    EXPECT_EQ(store->metadata("player"), std::nullopt);
    EXPECT_EQ(store->status().queued, 0u);
    EXPECT_EQ(store->status().durable, 0u);
    EXPECT_EQ(store->status().waiting, 0u);
    EXPECT_TRUE(store->flush());
}

TEST_P(ChunkStoreContract, ChunksComeBack) {
    const auto store = world_->open();
    const ChunkPos corner{world::kMinChunk, world::kMaxChunk}, other{world::kMaxChunk, world::kMinChunk};
    store->save({0, 0}, numberedChunk(1), Provenance::Edited);
    store->save(corner, numberedChunk(2), Provenance::Generated);
    store->save(other, numberedChunk(3), Provenance::Edited);
    for (const char* when : {"before flush()", "after it"}) {
        SCOPED_TRACE(when);
        for (const auto& [pos, number] : {std::pair(ChunkPos{0, 0}, 1), {corner, 2}, {other, 3}}) {
            EXPECT_TRUE(store->contains(pos));
            const LoadedChunk loaded = store->load(pos);
            ASSERT_EQ(loaded.state, State::Present);
            EXPECT_EQ(*loaded.chunk, *numberedChunk(number));
            EXPECT_EQ(loaded.provenance, number == 2 ? Provenance::Generated : Provenance::Edited);
            EXPECT_EQ(loaded.problem, "");
        }
        EXPECT_EQ(store->load({0, 1}).state, State::Absent);
        ASSERT_TRUE(store->flush());
    }
}

// Blocks, block states and block entity data in all representations, with ids of the registry.
TEST_P(ChunkStoreContract, AllThatAChunkHasComesBack) {
    const auto store = world_->open();
    std::mt19937 random(1);
    std::vector<world::Chunk> chunks;
    for (int x = 0; x < 20; ++x) {
        world::Chunk chunk;
        for (int n = 0; n < world::kSectionsPerChunk; ++n) {
            chunk.setSection(n, world::Section(static_cast<world::BlockId>(random() % 6)));
            for (int k = 0; k < 100; ++k)
                chunk.setBlock(static_cast<world::BlockIndex>(n << 12 | (random() & 4095)),
                               static_cast<world::BlockId>(random() % 6));
            if (random() % 2) chunk.setBlockStateSection(n, randomSection(random, 40));
        }
        for (std::size_t count = random() % 30; count > 0; --count)
            chunk.setBlockEntityData(randomIndex(random), randomBytes(random, random() % 300));
        store->save({x, -x}, std::make_shared<world::Chunk>(chunk), Provenance::Edited);
        chunks.push_back(std::move(chunk));
    }
    ASSERT_TRUE(store->flush());
    for (int x = 0; x < 20; ++x)
        EXPECT_EQ(*store->load({x, -x}).chunk, chunks[static_cast<std::size_t>(x)]) << x;
}

TEST_P(ChunkStoreContract, LevelsAreApart) {
    const auto store = world_->open();
    const auto posAt = [](int level) { return ChunkPos{3, -4, static_cast<std::uint8_t>(level)}; };
    for (int level = 0; level <= world::kMaxLevel; level += 3)
        store->save(posAt(level), numberedChunk(level), Provenance::Generated);
    for (int round = 0; round < 2; ++round) {
        for (int level = 0; level <= world::kMaxLevel; ++level) {
            const LoadedChunk loaded = store->load(posAt(level));
            EXPECT_EQ(store->contains(posAt(level)), level % 3 == 0) << level;
            ASSERT_EQ(loaded.state, level % 3 == 0 ? State::Present : State::Absent) << level;
            if (loaded.chunk) {
                EXPECT_EQ(*loaded.chunk, *numberedChunk(level));
            }
        }
        ASSERT_TRUE(store->flush());
    }
}

TEST_P(ChunkStoreContract, GeneratedNeverReplacesEdited) {
    const auto store = world_->open();
    const auto expectNumber = [&](int number, Provenance provenance) {
        const LoadedChunk loaded = store->load({0, 0});
        ASSERT_EQ(loaded.state, State::Present);
        EXPECT_EQ(*loaded.chunk, *numberedChunk(number));
        EXPECT_EQ(loaded.provenance, provenance);
    };
    for (const bool flushes : {true, false}) {
        const int n = flushes ? 0 : 10;
        const auto saveAs = [&](int number, Provenance provenance) {
            store->save({0, 0}, numberedChunk(number), provenance);
            if (flushes) {
                ASSERT_TRUE(store->flush());
            }
        };
        saveAs(n + 1, Provenance::Generated);
        if (flushes) {
            expectNumber(n + 1, Provenance::Generated);
            saveAs(n + 2, Provenance::Generated);
            expectNumber(n + 2, Provenance::Generated);
        } else {
            expectNumber(5, Provenance::Edited);  // saved by the first round
        }
        saveAs(n + 3, Provenance::Edited);
        expectNumber(n + 3, Provenance::Edited);
        saveAs(n + 4, Provenance::Generated);
        expectNumber(n + 3, Provenance::Edited);
        saveAs(n + 5, Provenance::Edited);
        expectNumber(n + 5, Provenance::Edited);
    }
}

TEST_P(ChunkStoreContract, ALoadedChunkIsTheCallersAlone) {
    const auto store = world_->open();
    const world::ChunkPtr saved = numberedChunk(1);
    store->save({0, 0}, saved, Provenance::Edited);
    for (int round = 0; round < 2; ++round) {
        const auto first = store->load({0, 0}).chunk, second = store->load({0, 0}).chunk;
        EXPECT_NE(first, second);
        EXPECT_EQ(first.use_count(), 1);
        first->setBlock(0, 4);
        EXPECT_EQ(*second, *numberedChunk(1));
        EXPECT_EQ(*saved, *numberedChunk(1));
        EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(1));
        ASSERT_TRUE(store->flush());
    }
}

TEST_P(ChunkStoreContract, LoadsManyInTheOrderAsked) {
    const auto store = world_->open();
    EXPECT_TRUE(store->loadMany({}).empty());
    std::vector<ChunkPos> positions;
    for (int x = 0; x < 40; ++x) {
        const ChunkPos pos{x % 7, -x, static_cast<std::uint8_t>(x % 2)};
        positions.push_back(pos);
        if (x % 3 > 0)
            store->save(pos, numberedChunk(x), x % 3 == 1 ? Provenance::Edited : Provenance::Generated);
        if (x == 20) {  // some are still queued
            ASSERT_TRUE(store->flush());
        }
    }
    std::swap(positions[1], positions[30]);
    positions.push_back(positions[4]);  // twice
    for (int round = 0; round < 2; ++round) {
        const auto many = store->loadMany(positions);
        ASSERT_EQ(many.size(), positions.size());
        for (std::size_t k = 0; k < positions.size(); ++k) {
            const LoadedChunk one = store->load(positions[k]);
            ASSERT_EQ(many[k].state, one.state) << k;
            EXPECT_EQ(many[k].provenance, one.provenance);
            if (one.chunk) {
                EXPECT_EQ(*many[k].chunk, *one.chunk);
            }
        }
        EXPECT_NE(many[4].chunk, many.back().chunk) << "each is the caller's alone";
        ASSERT_TRUE(store->flush());
    }
}

TEST_P(ChunkStoreContract, Metadata) {
    const auto store = world_->open();
    EXPECT_EQ(store->setMetadata("player", "1,2,3"), 1u);
    EXPECT_EQ(store->setMetadata("time", ""), 2u);
    EXPECT_EQ(store->metadata("player"), "1,2,3");
    EXPECT_EQ(store->metadata("time"), "") << "empty, and there";
    EXPECT_EQ(store->setMetadata("player", "4"), 3u);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(store->metadata("player"), "4");
}

TEST_P(ChunkStoreContract, TheIdentityIsNoMetadataToBeSet) {
    const auto store = world_->open();
    for (const char* name : {"seed", "generator", "generator_version"}) store->setMetadata(name, "x");
    EXPECT_EQ(store->status().queued, 0u);
    EXPECT_EQ(store->identity(), kIdentity);
    EXPECT_NE(store->metadata("seed"), "x");
}

TEST_P(ChunkStoreContract, SavesAreNumberedAndGetDurable) {
    const auto store = world_->open();
    EXPECT_EQ(store->save({0, 0}, numberedChunk(1), Provenance::Edited), 1u);
    EXPECT_EQ(store->save({0, 0}, numberedChunk(2), Provenance::Generated), 2u)
        << "also where it is not taken";
    EXPECT_EQ(store->setMetadata("a", "b"), 3u);
    EXPECT_EQ(store->status().queued, 3u);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(store->status().durable, 3u);
    EXPECT_EQ(store->status().waiting, 0u);
    EXPECT_EQ(store->status().problem, "");
}

TEST_P(ChunkStoreContract, WhatIsSavedOutlivesAPersistentStoreAlone) {
    bool isPersistent = false;
    {
        const auto store = world_->open();
        isPersistent = store->isPersistent();
        store->save({5, -6, 2}, numberedChunk(1), Provenance::Edited);
        store->setMetadata("player", "1,2,3");
    }
    const auto store = world_->open();
    EXPECT_EQ(store->identity(), kIdentity);
    ASSERT_EQ(store->load({5, -6, 2}).state, isPersistent ? State::Present : State::Absent);
    if (!isPersistent) return;
    EXPECT_EQ(*store->load({5, -6, 2}).chunk, *numberedChunk(1));
    EXPECT_EQ(store->load({5, -6, 2}).provenance, Provenance::Edited);
    EXPECT_EQ(store->metadata("player"), "1,2,3");
}

TEST_P(ChunkStoreContract, LoadsAndSavesFromManyThreads) {
    const auto store = world_->open();
    constexpr int kChunks = 200;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (int i = 0; i < kChunks; ++i) {
                store->save({i, t}, numberedChunk(i * 4 + t), Provenance::Edited);
                if (i % 60 == t && !store->flush()) ADD_FAILURE() << "flush";
                const ChunkPos seen[] = {{i / 2, t}, {i / 3, t}};
                const auto many = store->loadMany(seen);
                for (std::size_t k = 0; k < many.size(); ++k)
                    if (!many[k].chunk || *many[k].chunk != *numberedChunk(seen[k].x * 4 + t))
                        ADD_FAILURE() << i << " " << t;
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(store->status().durable, 4u * kChunks);
    for (int t = 0; t < 4; ++t)
        for (int i = 0; i < kChunks; ++i) ASSERT_TRUE(store->contains({i, t}));
}

}  // namespace
}  // namespace terrane::store
