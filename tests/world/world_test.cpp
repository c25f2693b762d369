#include "terrane/world/world.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <memory>
#include <thread>

#include "tests/world/lowest_highest.h"

namespace terrane::world {
namespace {

TEST(World, AirWhereNothingIsLoaded) {
    World world;
    EXPECT_EQ(world.maybeChunkAt({0, 0}), nullptr);
    EXPECT_EQ(world.block({1, 2, 3}), kAir);
    EXPECT_FALSE(world.setBlock({1, 2, 3}, 5));
    EXPECT_TRUE(world.chunks().empty());
    EXPECT_EQ(world.memoryBytes(), 0u);
}

TEST(World, AirAboveAndBelow) {
    World world;
    auto chunk = std::make_shared<Chunk>();
    for (int number = 0; number < kSectionsPerChunk; ++number) chunk->setSection(number, Section(3));
    world.insert({0, 0}, std::move(chunk));
    EXPECT_EQ(world.block({0, 0, -1}), kAir);
    EXPECT_EQ(world.block({0, 0, 0}), 3);
    EXPECT_EQ(world.block({0, 0, 255}), 3);
    EXPECT_EQ(world.block({0, 0, 256}), kAir);
    EXPECT_EQ(world.block({0, 0, kLowest}), kAir);
    EXPECT_FALSE(world.setBlock({0, 0, -1}, 5));
    EXPECT_FALSE(world.setBlock({0, 0, 256}, 5));
    EXPECT_EQ(world.maybeChunkAt({0, 0})->section(0), Section(3));
}

TEST(World, BlocksAtTheCornersOfTheWorld) {
    World world;
    BlockId id = 1;
    for (const std::int32_t x : {kLowest, -1, 0, kHighest})
        for (const std::int32_t y : {kLowest, -1, 0, kHighest}) {
            world.insert(chunkOf({x, y, 0}), std::make_shared<Chunk>());
            EXPECT_TRUE(world.setBlock({x, y, 200}, id));
            EXPECT_EQ(world.block({x, y, 200}), id);
            EXPECT_EQ(world.maybeChunkAt(chunkOf({x, y, 0}))->block(blockIndex({x, y, 200})), id);
            ++id;
        }
    EXPECT_EQ(world.chunks().size(), 16u);
}

TEST(World, InsertReplacesAndEraseForgets) {
    World world;
    auto first = std::make_shared<Chunk>(), second = std::make_shared<Chunk>();
    second->setBlock(0, 2);
    world.insert({4, -4}, first);
    world.insert({4, -4}, second);
    EXPECT_EQ(world.maybeChunkAt({4, -4}), second);
    EXPECT_EQ(world.block({64, -64, 0}), 2);
    world.erase({4, -4});
    EXPECT_EQ(world.maybeChunkAt({4, -4}), nullptr);
    world.erase({4, -4});
}

TEST(World, EditLeavesSnapshotsAsTheyWere) {
    World world;
    world.insert({0, 0}, std::make_shared<Chunk>());
    ASSERT_TRUE(world.setBlock({1, 1, 1}, 7));
    const ChunkPtr snapshot = world.maybeChunkAt({0, 0});
    ASSERT_TRUE(world.setBlock({1, 1, 1}, 8));
    ASSERT_TRUE(world.setBlock({2, 1, 1}, 9));
    EXPECT_EQ(snapshot->block(blockIndex(1, 1, 1)), 7);
    EXPECT_EQ(snapshot->block(blockIndex(2, 1, 1)), kAir);
    EXPECT_EQ(world.block({1, 1, 1}), 8);
    EXPECT_EQ(world.block({2, 1, 1}), 9);
    EXPECT_NE(world.maybeChunkAt({0, 0}), snapshot);
}

TEST(World, EditOfAnUnsharedChunkCopiesNothing) {
    World world;
    world.insert({0, 0}, std::make_shared<Chunk>());
    const Chunk* before = world.maybeChunkAt({0, 0}).get();
    ASSERT_TRUE(world.setBlock({1, 1, 1}, 7));
    EXPECT_EQ(world.maybeChunkAt({0, 0}).get(), before);
}

TEST(World, MemoryIsTheSumOfChunks) {
    World world;
    world.insert({0, 0}, std::make_shared<Chunk>());
    world.insert({1, 0}, std::make_shared<Chunk>());
    EXPECT_EQ(world.memoryBytes(), 2 * sizeof(Chunk));
    world.setBlock({0, 0, 0}, 1);
    EXPECT_GT(world.memoryBytes(), 2 * sizeof(Chunk) + 500);
}

// A worker reads a snapshot and lets it go; from then on edits go to the very chunk it read. Thread
// sanitizers see whether the reading is ordered before the writing: `done` itself orders nothing.
TEST(World, EditsOfAChunkThatAWorkerHasRead) {
    World world;
    world.insert({0, 0}, std::make_shared<Chunk>());
    for (int round = 1; round <= 200; ++round) {
        std::atomic<bool> done = false;
        std::thread worker([&done, snapshot = world.maybeChunkAt({0, 0})]() mutable {
            EXPECT_EQ(snapshot->block(0), snapshot->block(1));
            snapshot.reset();
            done.store(true, std::memory_order_relaxed);
        });
        if (round % 2 == 0)
            while (!done.load(std::memory_order_relaxed)) std::this_thread::yield();
        for (const std::int32_t x : {0, 1}) world.setBlock({x, 0, 0}, static_cast<BlockId>(round));
        worker.join();
        EXPECT_EQ(world.block({1, 0, 0}), round);
    }
}

TEST(World, DataOfBlocks) {
    World world;
    const BlockPos pos{-5, 17, 100}, above{-5, 17, 256};
    const LargeData text{std::byte{'a'}, std::byte{'b'}};
    EXPECT_FALSE(world.setSmallData(pos, 1));
    EXPECT_FALSE(world.setLargeData(pos, text));
    EXPECT_FALSE(world.clearLargeData(pos));
    EXPECT_EQ(world.smallData(pos), 0);
    EXPECT_EQ(world.largeData(pos), nullptr);

    world.insert(chunkOf(pos), std::make_shared<Chunk>());
    EXPECT_FALSE(world.setSmallData(above, 1));
    EXPECT_EQ(world.smallData(above), 0);
    EXPECT_TRUE(world.setSmallData(pos, 7));
    EXPECT_EQ(world.smallData(pos), 7);
    const ChunkPtr before = world.maybeChunkAt(chunkOf(pos));
    EXPECT_TRUE(world.setLargeData(pos, text));
    ASSERT_NE(world.largeData(pos), nullptr);
    EXPECT_EQ(*world.largeData(pos), text);
    EXPECT_EQ(before->largeData(blockIndex(pos)), nullptr) << "a snapshot stays as it is";
    EXPECT_TRUE(world.setBlock(pos, 3));
    EXPECT_EQ(world.largeData(pos), nullptr) << "gone with the block";
    EXPECT_TRUE(world.setLargeData(pos, text));
    EXPECT_TRUE(world.clearLargeData(pos));
    EXPECT_EQ(world.largeData(pos), nullptr);
    EXPECT_EQ(world.smallData(pos), 0);
}

}  // namespace
}  // namespace terrane::world
