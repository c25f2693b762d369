// areas.cpp and read_chunks.cpp.
#include <gmock/gmock.h>

#include <thread>

#include "terrane/volume/read_chunks.h"
#include "terrane/world/chunk.h"
#include "tests/support/default_heights.h"
#include "tests/volume/volume_fixture.h"

namespace terrane::volume {
namespace {

TEST(ReadBlocks, AreasAreThoseOfTheGenerator) {
    const auto world = openWorld("overworld");
    const gen::Generator& generator = **world->generator(0);
    std::mt19937 random(1);
    for (int k = 0; k < 6; ++k) {
        const BlockArea area = randomArea(random);
        const auto blocks = blocksOf(*world, area);
        std::map<world::ChunkPos, world::Chunk> chunks;
        int wrong = 0;
        forEachBlock(area, [&](auto x, auto y, auto z, std::size_t place) {
            const world::ChunkPos pos = chunkAtBlock(x, y);
            if (!chunks.contains(pos)) chunks.emplace(pos, generator.generate(pos));
            const auto at =
                world::blockIndex(static_cast<int>(x & 15), static_cast<int>(y & 15), static_cast<int>(z));
            wrong += chunks.at(pos).block(at) != blocks[place];
        });
        EXPECT_EQ(wrong, 0);
    }
}

TEST(ReadBlocks, TheLastCornerOfTheWorldIsThere) {
    const auto world = openWorld("flat");
    constexpr std::int64_t kEnd = std::int64_t{1} << 31;
    EXPECT_THAT(blocksOf(*world, {kEnd - 2, kEnd - 2, 80, kEnd, kEnd, 81}),
                testing::Each(contentBlock("grass")));
    EXPECT_THAT(blocksOf(*world, {-kEnd, -kEnd, 81, 2 - kEnd, 2 - kEnd, 82}), testing::Each(world::kAir));
}

TEST(ReadBlocks, ChunksOfAllLevels) {
    const auto world = openWorld("overworld");
    const std::vector<world::ChunkPos> chunks = {{3, -2}, {0, 1, 4}, {-1, 0, 15}};
    std::vector<world::BlockId> blocks(chunks.size() * world::kBlocksPerChunk);
    ASSERT_TRUE(readChunkArrays(*world, chunks, blocks, {}));
    for (std::size_t k = 0; k < chunks.size(); ++k) {
        const world::Chunk chunk = (*world->generator(chunks[k].level))->generate(chunks[k]);
        int wrong = 0;
        for (int i = 0; i < world::kBlocksPerChunk; ++i)
            wrong += chunk.block(static_cast<world::BlockIndex>(i)) !=
                     blocks[k * world::kBlocksPerChunk + static_cast<std::size_t>(i)];
        EXPECT_EQ(wrong, 0) << k;
    }
}

TEST(ReadBlocks, AChunkOutsideIsRefused) {
    const auto world = openWorld("flat");
    const world::ChunkPos outside[] = {{world::kMaxChunk, 0, 1}};
    std::vector<world::BlockId> blocks(world::kBlocksPerChunk);
    const auto read = readChunkArrays(*world, outside, blocks, {});
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, base::ErrorCode::BadInput);
    EXPECT_THAT(read.error().message, testing::HasSubstr("of level 1: outside the world"));
}

TEST(ReadBlocks, TheDigestIsThatOfAllChunksInOrder) {
    const world::ChunkArea area{-3, 2, 31, 37};  // 34 × 35 chunks, more than are kept at once
    for (const unsigned threads : {1u, 3u}) {
        const auto world = openWorld("flat", threads);
        const world::ChunkPos changed[] = {{-3, 2}, {30, 36}};
        for (const world::ChunkPos pos : changed) {
            auto chunk = std::make_shared<world::Chunk>((*world->generator(0))->generate(pos));
            chunk->setBlock(0, contentBlock("stone"));
            chunk->setBlock(5, contentBlock("sand"));
            world->store().save(pos, chunk, store::Provenance::Edited);
        }
        base::Digest digest;
        for (std::int64_t k = 0; k < area.chunkCount(); ++k) {
            world::Chunk chunk = (*world->generator(0))->generate(chunkIn(area, k));
            if (std::ranges::count(changed, chunkIn(area, k)) > 0) {
                chunk.setBlock(0, contentBlock("stone"));
                chunk.setBlock(5, contentBlock("sand"));
            }
            world::addToDigest(digest, chunk);
        }
        const auto found = digestOf(*world, area, {});
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, digest.hex());
    }
}

TEST(ReadChunks, ItStopsWhereTheCallerSaysSo) {
    const auto world = openWorld("flat");
    std::atomic<int> used{0};
    const auto read = readChunks(
        *world, chunksOf({0, 0, 1000, 1000}), [&] { return used < 100; },
        [&](std::int64_t, const world::Chunk&) { ++used; });
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message, kStopped);
    EXPECT_LT(used, 1000000);
}

TEST(ReadChunks, ManyCallsAtATimeDoNotMix) {
    const auto world = openWorld("overworld");
    const auto expected = blocksOf(*world, {-20, -20, 60, 20, 20, 100});
    std::vector<std::thread> threads;
    std::atomic<int> wrong{0};
    for (int k = 0; k < 4; ++k)
        threads.emplace_back([&] {
            for (int round = 0; round < 5; ++round)
                wrong += blocksOf(*world, {-20, -20, 60, 20, 20, 100}) != expected;
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0);
}

// A store that has something it cannot read.
class UnreadableStore : public store::MemoryStore {
  public:
    using MemoryStore::MemoryStore;
    std::vector<store::LoadedChunk> loadMany(std::span<const world::ChunkPos> positions) override {
        auto loaded = MemoryStore::loadMany(positions);
        for (std::size_t k = 0; k < positions.size(); ++k)
            if (positions[k] == world::ChunkPos{1, 1}) {
                loaded[k].state = store::LoadedChunk::State::Damaged;
                loaded[k].problem = "the disk is gone";
                loaded[k].isUnreadable = isUnreadable;
            }
        return loaded;
    }
    bool isUnreadable = true;
};

TEST(ReadChunks, AChunkThatCannotBeReadIsAnError) {
    auto store = std::make_unique<UnreadableStore>(store::WorldIdentity{kVolumeSeed, "flat", 1});
    UnreadableStore& disk = *store;
    const auto world = openWorld("flat", std::move(store));
    std::vector<world::BlockId> blocks(32 * 32);
    const auto read = readBlocks(*world, {0, 0, 80, 32, 32, 81}, blocks, {});
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, base::ErrorCode::Io);
    EXPECT_EQ(read.error().message, "chunk 1,1: the disk is gone");
    // One that is damaged is generated, as in a game.
    disk.isUnreadable = false;
    EXPECT_THAT(blocksOf(*world, {0, 0, 80, 32, 32, 81}), testing::Each(contentBlock("grass")));
}

}  // namespace
}  // namespace terrane::volume
