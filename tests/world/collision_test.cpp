#include "terrane/world/character.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::world {
namespace {

// A floor of stone (z < 10) over 3×3 chunks.
class CollisionTest : public testing::Test {
  protected:
    CollisionTest() {
        for (int n = 0; n < 9; ++n) {
            auto chunk = std::make_shared<Chunk>();
            for (int i = 0; i < 10 * 256; ++i)
                chunk->setBlock(static_cast<BlockIndex>(i), contentBlock("stone"));
            world_.insert({n % 3 - 1, n / 3 - 1}, chunk);
        }
    }
    void put(BlockPos pos, std::string_view name) { putBlock(world_, pos, contentBlock(name)); }
    Sweep move(const Aabb& box, glm::dvec3 motion) const {
        return sweep(world_, contentBlocks(), box, motion);
    }
    bool overlaps(const Aabb& box) const { return collides(world_, contentBlocks(), box); }

    World world_;
};

Aabb playerAt(glm::dvec3 feet) {
    return {feet - glm::dvec3(0.3, 0.3, 0), feet + glm::dvec3(0.3, 0.3, 1.8)};
}

TEST_F(CollisionTest, FallsOntoTheFloor) {
    const Sweep s = move(playerAt({4.5, 4.5, 15}), {0, 0, -20});
    EXPECT_NEAR(s.moved.z, -5, 2 * kSkin);
    EXPECT_GE(15 + s.moved.z, 10);
    EXPECT_EQ(s.blocked, glm::bvec3(false, false, true));
    EXPECT_EQ(move(playerAt({4.5, 4.5, 15}), {0, 0, -3}).moved.z, -3);
}

TEST_F(CollisionTest, SlidesAlongAWall) {
    for (int z = 10; z < 14; ++z) put({6, 4, z}, "stone");
    const Sweep s = move(playerAt({4.5, 4.5, 10.1}), {3, 0.25, 0});
    EXPECT_NEAR(s.moved.x, 1.2, 2 * kSkin);
    EXPECT_EQ(s.moved.y, 0.25);
    EXPECT_EQ(s.blocked, glm::bvec3(true, false, false));
}

TEST_F(CollisionTest, PassesPlantsAndWaterAndStopsAtACactusSide) {
    put({6, 4, 10}, "poppy");
    put({6, 4, 11}, "water");
    EXPECT_EQ(move(playerAt({4.5, 4.5, 10.1}), {4, 0, 0}).moved.x, 4);
    put({6, 4, 10}, "cactus");
    EXPECT_NEAR(move(playerAt({4.5, 4.5, 10.1}), {4, 0, 0}).moved.x, 1.2 + 1.0 / 16, 2 * kSkin);
}

TEST_F(CollisionTest, WhatIsNotLoadedStops) {
    const Sweep s = move(playerAt({28.5, 4.5, 10.1}), {30, 0, 0});
    EXPECT_NEAR(s.moved.x, 32 - 28.8, 2 * kSkin);
    EXPECT_TRUE(s.blocked.x);
    EXPECT_EQ(move(playerAt({28.5, 4.5, 300}), {30, 0, 0}).moved.x, 30) << "above the world there is nothing";
}

TEST_F(CollisionTest, ABoxInsideABlockCanLeave) {
    for (const glm::dvec3 motion : {glm::dvec3(0, 0, 3), {2, 0, 0}, {0, -2, 0}}) {
        World empty;
        empty.insert({0, 0}, std::make_shared<Chunk>());
        putBlock(empty, {8, 8, 50}, contentBlock("stone"));
        EXPECT_EQ(sweep(empty, contentBlocks(), playerAt({8.5, 8.5, 50.2}), motion).moved, motion);
    }
}

TEST_F(CollisionTest, TheEdgeOfTheWorldHolds) {
    const ChunkPos corner{kMaxChunk, kMaxChunk};
    auto chunk = std::make_shared<Chunk>();
    world_.insert(corner, chunk);
    const Sweep s = move(playerAt({2147483640.5, 2147483640.5, 50}), {60, 60, 0});
    EXPECT_LT(s.moved.x, 9);
    EXPECT_LT(s.moved.y, 9);
}

TEST_F(CollisionTest, Liquids) {
    put({3, 3, 10}, "water");
    EXPECT_TRUE(isInLiquid(world_, contentBlocks(), {3.5, 3.5, 10.5}));
    EXPECT_FALSE(isInLiquid(world_, contentBlocks(), {3.5, 3.5, 11.0}));
    EXPECT_FALSE(isInLiquid(world_, contentBlocks(), {4.5, 3.5, 10.5}));
}

// At any speed and place the box never ends inside a block, and its path, in steps of 1/64 block, is free. It
// stops only if it could not have gone any farther.
TEST_F(CollisionTest, NeverTunnels) {
    std::mt19937 random(1);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int n = 0; n < 2500; ++n) {
        put({static_cast<int>(between(-16, 32)), static_cast<int>(between(-16, 32)),
             static_cast<int>(between(10, 40))},
            n % 5 == 0 ? "cactus" : "stone");
    }
    int blocked = 0;
    for (int round = 0; round < 1500; ++round) {
        const glm::dvec3 at(between(-14, 30), between(-14, 30), between(10, 40));
        const glm::dvec3 half(between(0.05, 0.9), between(0.05, 0.9), between(0.05, 1));
        Aabb box{at - half, at + half};
        if (overlaps(box)) continue;
        const double speed = round % 2 == 0 ? 1 : 60;
        const glm::dvec3 motion(between(-speed, speed), between(-speed, speed), between(-speed, speed));
        const Sweep s = move(box, motion);
        for (const int axis : {2, 0, 1}) {
            const int steps = static_cast<int>(std::ceil(std::abs(s.moved[axis]) * 64));
            for (int k = 1; k <= steps; ++k) {
                Aabb there = box;
                there.min[axis] += s.moved[axis] * k / steps;
                there.max[axis] += s.moved[axis] * k / steps;
                ASSERT_FALSE(overlaps(there)) << "round " << round << ", axis " << axis;
            }
            box.min[axis] += s.moved[axis];
            box.max[axis] += s.moved[axis];
            if (!s.blocked[axis]) continue;
            ++blocked;
            Aabb farther = box;
            (motion[axis] > 0 ? farther.max : farther.min)[axis] += std::copysign(2 * kSkin, motion[axis]);
            ASSERT_TRUE(overlaps(farther)) << "round " << round << ", axis " << axis;
        }
    }
    EXPECT_GT(blocked, 500);
}

TEST_F(CollisionTest, AMotionIsANumber) {
    EXPECT_THROW(move(playerAt({4.5, 4.5, 15}), {0, std::numeric_limits<double>::quiet_NaN(), 0}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace terrane::world
