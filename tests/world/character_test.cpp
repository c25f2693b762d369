#include "terrane/world/character.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>

#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::world {
namespace {

// A floor of stone (z < 10) over 5×5 chunks.
class CharacterTest : public testing::Test {
  protected:
    CharacterTest() {
        for (int n = 0; n < 25; ++n) {
            auto chunk = std::make_shared<Chunk>();
            for (int i = 0; i < 10 * 256; ++i)
                chunk->setBlock(static_cast<BlockIndex>(i), contentBlock("stone"));
            world_.insert({n % 5 - 2, n / 5 - 2}, chunk);
        }
    }
    void fill(BlockPos from, BlockPos to, std::string_view name) {
        for (int z = from.z; z <= to.z; ++z)
            for (int y = from.y; y <= to.y; ++y)
                for (int x = from.x; x <= to.x; ++x) putBlock(world_, {x, y, z}, contentBlock(name));
    }
    void run(double seconds, const CharacterInput& input) {
        for (int n = 0; n < static_cast<int>(std::lround(seconds / kStepSeconds)); ++n) {
            c_ = advanceCharacter(world_, contentBlocks(), c_, input);
            highest_ = std::max(highest_, c_.feet.z);
        }
    }

    World world_;
    Character c_{.feet = {0.5, 0.5, 10.01}};
    double highest_ = 0;
};

TEST_F(CharacterTest, StandsStill) {
    run(2, {});
    EXPECT_TRUE(c_.isOnGround);
    EXPECT_NEAR(c_.feet.z, 10, 0.01);
    EXPECT_EQ(glm::dvec2(c_.feet), glm::dvec2(0.5, 0.5));
}

TEST_F(CharacterTest, WalksAtWalkingSpeed) {
    run(1, {});
    run(1, {.direction = {1, 0}});
    const double start = c_.feet.x;
    run(1, {.direction = {1, 0}});
    EXPECT_NEAR(c_.feet.x - start, kWalkSpeed, 0.05);
    run(1, {});
    EXPECT_NEAR(glm::length(c_.velocity), 0, 0.3) << "and stops";
}

TEST_F(CharacterTest, AJumpReachesOneBlock) {
    run(1, {});
    highest_ = 0;
    run(0.1, {.jumps = true});
    run(2, {});
    EXPECT_GT(highest_, 11.15);
    EXPECT_LT(highest_, 11.5);
    EXPECT_TRUE(c_.isOnGround);
}

TEST_F(CharacterTest, AFullBlockStopsAndAJumpPassesIt) {
    fill({3, -40, 10}, {40, 40, 10}, "stone");
    run(2, {.direction = {1, 0}});
    EXPECT_NEAR(c_.feet.x, 3 - kCharacterWidth / 2, 0.01);
    run(1, {.direction = {1, 0}, .jumps = true});
    EXPECT_GT(c_.feet.x, 3.5);
    EXPECT_GE(c_.feet.z, 11);
}

TEST_F(CharacterTest, FallsFasterAndNotThroughTheFloor) {
    c_.feet.z = 250;
    run(1, {});
    EXPECT_LT(c_.velocity.z, -20);
    run(9, {});
    EXPECT_NEAR(c_.feet.z, 10, 0.01);
}

TEST_F(CharacterTest, SwimsUpAndSinksSlowly) {
    fill({-30, -30, 10}, {30, 30, 20}, "water");
    c_.feet.z = 13;
    run(1, {});
    EXPECT_TRUE(c_.isSwimming);
    EXPECT_GT(c_.feet.z, 12);
    EXPECT_LT(c_.feet.z, 13);
    run(5, {.jumps = true});
    EXPECT_GT(c_.feet.z, 19.5);
    EXPECT_LT(c_.feet.z, 22);
}

TEST_F(CharacterTest, WithoutGravityItStopsAtWalls) {
    fill({3, -40, 10}, {3, 40, 40}, "stone");
    run(2, {.direction = {1, 0}, .jumps = true, .hasGravity = false});
    EXPECT_NEAR(c_.feet.x, 3 - kCharacterWidth / 2, 0.01);
    EXPECT_NEAR(c_.feet.z, 10 + 2 * kFlySpeed, 1);
    run(1, {.hasGravity = false});
    EXPECT_NEAR(c_.velocity.z, 0, 0.01) << "it does not fall";
}

TEST_F(CharacterTest, IsLiftedOutOfABlock) {
    fill({0, 0, 10}, {0, 0, 12}, "stone");
    run(2, {});
    EXPECT_GE(c_.feet.z, 13);
    EXPECT_FALSE(collides(world_, contentBlocks(), characterBox(c_.feet)));
}

TEST_F(CharacterTest, WaitsWhereNothingIsLoaded) {
    c_.feet = {1000.5, 0.5, 60};
    run(3, {.direction = {1, 0}});
    EXPECT_EQ(c_.feet, glm::dvec3(1000.5, 0.5, 60));
}

TEST_F(CharacterTest, WaitsWhereItReachesIntoWhatIsNotLoaded) {
    world_.erase({1, 0});
    c_.feet = {15.9, 0.5, 10.01};
    run(1, {.direction = {1, 0}});
    EXPECT_EQ(c_.feet, glm::dvec3(15.9, 0.5, 10.01));
    world_.insert({1, 0}, std::make_shared<Chunk>(*world_.maybeChunkAt({0, 0})));
    run(1, {});
    EXPECT_NEAR(c_.feet.z, 10, 0.01) << "it goes on once the chunk is there";
}

TEST_F(CharacterTest, WaitsWhereNothingIsMade) {
    world_ = World({-64, 64});
    const auto flat = [](int top) {
        auto chunk = std::make_shared<Chunk>(Heights{-64, 64});
        for (int z = -64; z < top; ++z)
            for (int k = 0; k < kBlocksPerLayer; ++k)
                chunk->setBlock(blockIndex(k % 16, k / 16, z), contentBlock("stone"));
        return chunk;
    };
    const auto shallow = flat(-64);
    shallow->unmakeBelow(0);
    world_.insert({0, 0}, shallow);
    c_.feet = {8.5, 8.5, -20};
    run(1, {.direction = {1, 0}});
    EXPECT_EQ(c_.feet, glm::dvec3(8.5, 8.5, -20)) << "as in a chunk that is not loaded";
    world_.makeDeeper({0, 0}, *flat(-40));
    run(3, {});
    EXPECT_NEAR(c_.feet.z, -40, 0.01) << "it falls once the ground is there";
}

TEST_F(CharacterTest, KeepsItsSpeedWhileItWaitsForTheGround) {
    world_ = World({-64, 64});
    auto chunk = std::make_shared<Chunk>(Heights{-64, 64});
    const Chunk whole = *chunk;
    chunk->unmakeBelow(0);
    world_.insert({0, 0}, chunk);
    c_.feet = {8.5, 8.5, 40};
    run(5, {});
    EXPECT_FALSE(c_.isOnGround);
    EXPECT_GE(c_.feet.z, 0);
    const double speed = c_.velocity.z;
    EXPECT_LT(speed, -30);
    world_.makeDeeper({0, 0}, whole);
    run(0.1, {});
    EXPECT_LT(c_.velocity.z, speed);
}

// A random walk among blocks: never inside of one, never through the floor.
TEST_F(CharacterTest, NeverEndsInsideABlock) {
    std::mt19937 random(3);
    for (int n = 0; n < 900; ++n) {
        const BlockPos at{static_cast<int>(random() % 60) - 30, static_cast<int>(random() % 60) - 30,
                          10 + static_cast<int>(random() % 3)};
        fill(at, at, n % 7 == 0 ? "cactus" : n % 11 == 0 ? "water" : "stone");
    }
    c_.feet.z = 30;
    for (int leg = 0; leg < 400; ++leg) {
        const double angle = static_cast<double>(random() % 628) / 100;
        const CharacterInput input{.direction = {std::cos(angle), std::sin(angle)},
                                   .runs = random() % 2 == 0,
                                   .jumps = random() % 3 == 0};
        for (int n = 0; n < 60; ++n) {
            c_ = advanceCharacter(world_, contentBlocks(), c_, input);
            ASSERT_FALSE(collides(world_, contentBlocks(), characterBox(c_.feet))) << "leg " << leg;
            ASSERT_GE(c_.feet.z, 10);
        }
    }
}

TEST_F(CharacterTest, JumpsOntoABlockByItselfWhereItIsToldTo) {
    fill({4, -3, 10}, {8, 3, 10}, "stone");
    run(3, {.direction = {1, 0}});
    EXPECT_NEAR(c_.feet.z, 10, 0.01);
    run(3, {.direction = {1, 0}, .autoJump = true});
    EXPECT_GT(c_.feet.x, 6);
}

TEST_F(CharacterTest, DoesNotJumpAtAWall) {
    fill({4, -3, 10}, {8, 3, 11}, "stone");
    run(3, {.direction = {1, 0}, .autoJump = true});
    EXPECT_NEAR(highest_, 10, 0.02);
}

TEST_F(CharacterTest, ClimbsALadder) {
    fill({4, -3, 10}, {4, 3, 14}, "stone");
    for (int z = 10; z <= 14; ++z) putBlock(world_, {3, 0, z}, contentBlock("ladder"));
    run(4, {.direction = {1, 0}});
    EXPECT_GT(highest_, 14.9) << "to the top";
    c_ = {.feet = {3.5, 0.5, 13}};
    run(1, {});
    EXPECT_GT(c_.feet.z, 12) << "and holds on";
    run(1, {.dives = true});
    EXPECT_LT(c_.feet.z, 11.5);
}

}  // namespace
}  // namespace terrane::world
