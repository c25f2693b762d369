#include "terrane/world/world.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <stdexcept>

#include "tests/support/default_heights.h"
#include "tests/world/lowest_highest.h"
#include "tests/world/put_block.h"

namespace terrane::world {
namespace {

TEST(World, AirWhereNothingIsLoaded) {
    World world;
    EXPECT_EQ(world.maybeChunkAt({0, 0}), nullptr);
    EXPECT_EQ(world.block({1, 2, 3}), kAir);
    EXPECT_EQ(world.blockState({1, 2, 3}), 0);
    EXPECT_EQ(world.blockEntityData({1, 2, 3}), nullptr);
    EXPECT_EQ(world.chunkCount(), 0u);
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
    EXPECT_EQ(world.maybeChunkAt({0, 0})->section(0), Section(3));
}

TEST(World, BlocksAtTheCornersOfTheWorld) {
    World world;
    BlockId id = 1;
    for (const std::int32_t x : {kLowest, -1, 0, kHighest})
        for (const std::int32_t y : {kLowest, -1, 0, kHighest}) {
            world.insert(chunkOf({x, y, 0}), std::make_shared<Chunk>());
            EXPECT_TRUE(putBlock(world, {x, y, 200}, id));
            EXPECT_EQ(world.block({x, y, 200}), id);
            EXPECT_EQ(world.maybeChunkAt(chunkOf({x, y, 0}))->block(blockIndex({x, y, 200})), id);
            ++id;
        }
    EXPECT_EQ(world.chunkCount(), 16u);
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

TEST(World, MemoryIsTheSumOfChunks) {
    World world;
    world.insert({0, 0}, std::make_shared<Chunk>());
    world.insert({1, 0}, std::make_shared<Chunk>());
    EXPECT_EQ(world.memoryBytes(), 2 * Chunk().memoryBytes());
    putBlock(world, {0, 0, 0}, 1);
    EXPECT_GT(world.memoryBytes(), 2 * Chunk().memoryBytes() + 500);
}

TEST(World, TakesOnlyChunksAndPlacesOfTheWorld) {
    World world;
    EXPECT_THROW(world.insert({0, 0}, nullptr), std::invalid_argument);
    EXPECT_THROW(world.insert({kMaxChunk + 1, 0}, std::make_shared<Chunk>()), std::invalid_argument);
    EXPECT_EQ(world.chunkCount(), 0u);
}

}  // namespace
}  // namespace terrane::world
