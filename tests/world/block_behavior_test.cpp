#include "terrane/world/blocks/block_behavior.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "terrane/shared/hash.h"
#include "terrane/world/changes/block_edit.h"
#include "tests/support/default_heights.h"
#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::world {
namespace {

using Edits = std::vector<BlockEdit>;

class BehaviorTest : public testing::Test {
  protected:
    explicit BehaviorTest(const BlockRegistry& blocks = contentBlocks(), Heights heights = {})
        : blocks_(blocks), world_(heights) {
        world_.insert({0, 0}, std::make_shared<Chunk>(heights));
    }
    Edits put(BlockPos pos, std::string_view name) {
        Edits edits;
        const BlockId id = name == "air" ? kAir : blocks_.find(name)->id;
        applyChange(world_, blocks_, pos, SetBlock{id}, edits);
        return edits;
    }
    std::string nameAt(BlockPos pos) const { return blocks_.type(world_.block(pos)).name; }

    const BlockRegistry& blocks_;
    World world_;
};

class FallingSand : public BehaviorTest {
  protected:
    const BlockId sand_ = contentBlock("sand"), stone_ = contentBlock("stone");
};

class TallShaft : public BehaviorTest {
  protected:
    TallShaft() : BehaviorTest(contentBlocks(), {kLowestBottom, kHighestTop}) {}
};

TEST_F(TallShaft, SandFallsThroughAnyHeight) {
    put({3, 4, 2000}, "sand");
    EXPECT_EQ(nameAt({3, 4, kLowestBottom}), "sand");
    put({3, 4, -100}, "stone");
    put({3, 4, kHighestTop - 1}, "sand");
    EXPECT_EQ(nameAt({3, 4, -99}), "sand");
    put({3, 4, -100}, "air");
    EXPECT_EQ(nameAt({3, 4, kLowestBottom + 1}), "sand");
}

TEST_F(TallShaft, AWholeColumnOfSandFalls) {
    put({5, 5, kLowestBottom + 1}, "stone");
    for (int z = kLowestBottom + 2; z < kHighestTop; ++z) put({5, 5, z}, "sand");
    put({5, 5, kLowestBottom + 1}, "air");
    for (int z = kLowestBottom; z < kHighestTop; ++z)
        ASSERT_EQ(nameAt({5, 5, z}), z < kHighestTop - 2 ? "sand" : "air") << z;
}

TEST_F(TallShaft, ADoorNeedsRoomUnderTheTop) {
    put({1, 1, kHighestTop - 2}, "stone");
    put({1, 1, kHighestTop - 1}, "oak_door");
    EXPECT_EQ(nameAt({1, 1, kHighestTop - 1}), "air");
}

TEST_F(FallingSand, FallsToTheNextBlockWhenTheOneBelowGoes) {
    put({3, 4, 5}, "stone");
    put({3, 4, 20}, "stone");
    put({3, 4, 21}, "sand");
    EXPECT_EQ(nameAt({3, 4, 21}), "sand");
    const Edits expected = {{{3, 4, 20}, stone_, kAir}, {{3, 4, 21}, sand_, kAir}, {{3, 4, 6}, kAir, sand_}};
    EXPECT_EQ(put({3, 4, 20}, "air"), expected);
    EXPECT_EQ(nameAt({3, 4, 6}), "sand");
    EXPECT_EQ(nameAt({3, 4, 21}), "air");
}

TEST_F(FallingSand, AColumnComesDownWithWhatStandsOnIt) {
    put({3, 4, 5}, "stone");
    for (int z = 6; z < 10; ++z) put({3, 4, z}, "sand");
    for (int z = 10; z < 12; ++z) put({3, 4, z}, "cactus");
    put({3, 4, 5}, "air");
    for (int z = 0; z < 4; ++z) EXPECT_EQ(nameAt({3, 4, z}), "sand") << z;
    for (int z = 4; z < 16; ++z) EXPECT_EQ(nameAt({3, 4, z}), "air") << z << ": cacti lose their ground";
}

TEST_F(FallingSand, FallsWhereItIsPlaced) {
    put({3, 4, 5}, "stone");
    const Edits expected = {{{3, 4, 90}, kAir, sand_}, {{3, 4, 90}, sand_, kAir}, {{3, 4, 6}, kAir, sand_}};
    EXPECT_EQ(put({3, 4, 90}, "sand"), expected);
    put({8, 8, 30}, "sand");
    EXPECT_EQ(nameAt({8, 8, 0}), "sand") << "the bottom of the world";
}

TEST_F(FallingSand, SinksInWaterAndStaysOnPlants) {
    for (int z = 0; z < 4; ++z) put({3, 4, z}, z == 0 ? "stone" : "water");
    put({3, 4, 9}, "sand");
    EXPECT_EQ(nameAt({3, 4, 1}), "sand");
    EXPECT_EQ(nameAt({3, 4, 2}), "water");
    put({5, 5, 0}, "dirt");
    put({5, 5, 1}, "poppy");
    put({5, 5, 9}, "sand");
    EXPECT_EQ(nameAt({5, 5, 2}), "sand");
}

// Generated and loaded sand stays until the block below changes.
TEST_F(FallingSand, OnlyEditsBelowLetItFall) {
    putBlock(world_, {3, 4, 60}, sand_);
    put({4, 4, 60}, "stone");
    put({4, 4, 60}, "air");
    put({3, 4, 61}, "stone");
    EXPECT_EQ(nameAt({3, 4, 60}), "sand");
    put({3, 4, 59}, "stone");
    put({3, 4, 59}, "air");
    EXPECT_EQ(nameAt({3, 4, 0}), "sand");
}

TEST_F(FallingSand, TheHighestColumnFallsInOneEdit) {
    put({3, 4, 0}, "stone");
    for (int z = 1; z < kChunkHeight; ++z) put({3, 4, z}, "sand");
    EXPECT_EQ(put({3, 4, 0}, "air").size(), 1u + 2 * 255);
    for (int z = 0; z < kChunkHeight; ++z) EXPECT_EQ(nameAt({3, 4, z}), z < 255 ? "sand" : "air") << z;
}

// Columns of a world settled by looking at every block from the bottom up.
class SlowColumns {
  public:
    static constexpr int kSide = 3, kHeight = 12;
    using Column = std::array<BlockId, kHeight>;

    // The rules of an edit, then those of sand and plants from below.
    void put(int x, int y, int z, BlockId id) {
        Column& column = columns_[static_cast<std::size_t>(x + kSide * y)];
        BlockId& cell = column[static_cast<std::size_t>(z)];
        if (id == contentBlock("poppy") && !isGround(z > 0 ? column[static_cast<std::size_t>(z - 1)] : kAir))
            return;
        if (cell != id) cell = id;
        for (std::size_t k = 0; k < kHeight; ++k) settle(column, k);
    }
    const Column& column(int x, int y) const { return columns_[static_cast<std::size_t>(x + kSide * y)]; }

  private:
    static bool isGround(BlockId id) {
        return id == contentBlock("sand") || id == contentBlock("stone") || id == contentBlock("poppy");
    }
    static void settle(Column& column, std::size_t z) {
        if (column[z] == contentBlock("poppy") && !(z > 0 && isGround(column[z - 1]))) column[z] = kAir;
        if (column[z] != contentBlock("sand")) return;
        std::size_t end = z;
        while (end > 0 && (column[end - 1] == kAir || column[end - 1] == contentBlock("water"))) --end;
        column[z] = kAir;
        column[end] = contentBlock("sand");
    }
    std::array<Column, kSide * kSide> columns_{};
};

// Random edits: the columns equal those of the slow rules, and the events cover every change.
TEST_F(FallingSand, RandomEditsAreThoseOfSlowRules) {
    constexpr std::array<std::string_view, 7> kNames = {"air",   "air",   "sand", "sand",
                                                        "stone", "water", "poppy"};
    SlowColumns slow;
    std::array<SlowColumns::Column, 9> told{};
    for (unsigned step = 0; step < 20000; ++step) {
        const auto random = [&](unsigned k, unsigned count) {
            return static_cast<int>(shared::hash2(step, k, 77) % count);
        };
        const int x = random(0, SlowColumns::kSide), y = random(1, SlowColumns::kSide);
        const int z = random(2, SlowColumns::kHeight);
        const std::string_view name = kNames[static_cast<std::size_t>(random(3, kNames.size()))];
        slow.put(x, y, z, name == "air" ? kAir : contentBlock(name));
        for (const BlockEdit& edit : put({x, y, z}, name)) {
            const auto column = static_cast<std::size_t>(edit.pos.x + SlowColumns::kSide * edit.pos.y);
            BlockId& before = told[column][static_cast<std::size_t>(edit.pos.z)];
            ASSERT_EQ(before, edit.before) << "step " << step;
            before = edit.after;
        }
        for (int k = 0; k < SlowColumns::kHeight; ++k) {
            const auto at = static_cast<std::size_t>(k);
            ASSERT_EQ(nameAt({x, y, k}), blocks_.type(slow.column(x, y)[at]).name) << step << ", z " << k;
            ASSERT_EQ(told[static_cast<std::size_t>(x + SlowColumns::kSide * y)][at], slow.column(x, y)[at]);
        }
    }
}

// Behaviors of a user of the library: iron rusts where water comes beside it, a bomb clears what is around
// it when it is removed, a lantern counts ticks in its state, two blocks turn into each other for ever.
BehaviorTable ownBehaviors() {
    BehaviorTable behaviors = builtInBehaviors();
    behaviors.add({.name = "rusts", .neighborChanged = [](BlockUpdate& update, BlockPos pos, Face side) {
                       const BlockId next = update.world().block(adjacent(pos, side));
                       if (update.blocks().type(next).shape == Shape::Liquid)
                           update.change(pos, SetBlock{update.blocks().find("rust")->id});
                   }});
    behaviors.add(
        {.name = "bursts", .removed = [](BlockUpdate& update, BlockPos pos, const RemovedBlock& bomb) {
             for (int face = 0; face < kFaceCount && bomb.state > 0; ++face)
                 update.change(adjacent(pos, static_cast<Face>(face)), SetBlock{kAir});
         }});
    behaviors.add({.name = "counts", .tick = [](BlockUpdate& update, BlockPos pos) {
                       const int state = update.world().blockState(pos);
                       update.change(pos, SetState{static_cast<std::uint16_t>(state + 1)});
                   }});
    behaviors.add({.name = "flickers", .placed = [](BlockUpdate& update, BlockPos pos) {
                       const bool isOn = update.world().block(pos) == update.blocks().find("on")->id;
                       update.change(pos, SetBlock{update.blocks().find(isOn ? "off" : "on")->id});
                   }});
    return behaviors;
}

const BlockRegistry& ownBlocks() {
    static const BlockRegistry blocks = BlockRegistry::parse(R"(block = [
    { name = "iron", shape = "cube", texture = "a", behaviors = ["rusts"] },
    { name = "rust", shape = "cube", texture = "a", behaviors = ["falling"] },
    { name = "bomb", shape = "cube", texture = "a", behaviors = ["bursts"] },
    { name = "lantern", shape = "cube", texture = "a", behaviors = ["counts", "falling"] },
    { name = "on", shape = "cube", texture = "a", behaviors = ["flickers"] },
    { name = "off", shape = "cube", texture = "a", behaviors = ["flickers"] },
    { name = "water", shape = "liquid", texture = "a", alpha = "blend", opacity = 1 },
])",
                                                             "own.toml", ownBehaviors())
                                            .value();
    return blocks;
}

class OwnBehaviors : public BehaviorTest {
  protected:
    OwnBehaviors() : BehaviorTest(ownBlocks()) {}
};

TEST_F(OwnBehaviors, ABlockTurnsIntoAnotherWhenItsNeighborChanges) {
    put({4, 4, 0}, "iron");
    put({5, 4, 0}, "rust");
    EXPECT_EQ(nameAt({4, 4, 0}), "iron");
    const Edits edits = put({4, 5, 0}, "water");
    ASSERT_EQ(edits.size(), 2u);
    EXPECT_EQ(edits[1], (BlockEdit{{4, 4, 0}, ownBlocks().find("iron")->id, ownBlocks().find("rust")->id}));
}

// Iron hangs in the air; the rust that it becomes falls.
TEST_F(OwnBehaviors, BehaviorsFollowFromEachOther) {
    put({4, 4, 9}, "iron");
    put({4, 4, 10}, "water");
    EXPECT_EQ(nameAt({4, 4, 9}), "air");
    EXPECT_EQ(nameAt({4, 4, 0}), "rust");
}

TEST_F(OwnBehaviors, NeighborsInChunksThatAreNotLoadedAreLeftOut) {
    put({0, 4, 9}, "iron");
    put({-1, 4, 9}, "water");
    EXPECT_EQ(nameAt({0, 4, 9}), "iron");
    world_.insert({-1, 0}, std::make_shared<Chunk>());
    put({-1, 4, 9}, "water");
    EXPECT_EQ(nameAt({0, 4, 0}), "rust");
}

TEST_F(OwnBehaviors, WhatIsRemovedIsKnownWithItsData) {
    for (int z = 3; z < 6; ++z) put({4, 4, z}, z == 4 ? "bomb" : "iron");
    put({4, 4, 4}, "water");
    EXPECT_EQ(nameAt({4, 4, 3}), "air") << "rusted by the water and fallen";
    put({8, 8, 3}, "iron");
    put({8, 8, 4}, "bomb");
    Edits edits;
    applyChange(world_, blocks_, {8, 8, 4}, SetState{1}, edits);
    put({8, 8, 4}, "air");
    EXPECT_EQ(nameAt({8, 8, 3}), "air") << "burst";
}

TEST_F(OwnBehaviors, ABlockThatFallsKeepsItsState) {
    put({4, 4, 8}, "iron");
    put({4, 4, 9}, "lantern");
    Edits edits;
    applyChange(world_, blocks_, {4, 4, 9}, SetState{5}, edits);
    applyChange(world_, blocks_, {4, 4, 9}, RunTick{}, edits);
    EXPECT_EQ(world_.blockState({4, 4, 9}), 6);
    put({4, 4, 8}, "air");
    EXPECT_EQ(nameAt({4, 4, 0}), "lantern");
    EXPECT_EQ(world_.blockState({4, 4, 0}), 6);
}

TEST_F(OwnBehaviors, OnesThatNeverEndAreCutOff) {
    const Edits edits = put({4, 4, 4}, "on");
    EXPECT_EQ(edits.size(), 1 + kMaxBehaviorCalls);
}

TEST(BehaviorTable, ABehaviorTakesThePlaceOfOneWithItsName) {
    BehaviorTable behaviors = builtInBehaviors();
    const std::size_t count = behaviors.names().size();
    behaviors.add({.name = "falling"});
    EXPECT_EQ(behaviors.names().size(), count);
    EXPECT_FALSE(behaviors.find("falling")->neighborChanged);
    EXPECT_TRUE(builtInBehaviors().find("falling")->neighborChanged);
    EXPECT_EQ(behaviors.find("nothing"), nullptr);
}

TEST(BehaviorTable, BlocksOfTheProgramHaveTheBuiltInOnes) {
    const auto namesOf = [](std::string_view block) {
        std::string names;
        for (const BehaviorPtr& behavior : contentBlocks().find(block)->behaviors)
            names += behavior->name + ' ';
        return names;
    };
    EXPECT_EQ(namesOf("wheat"), "plant crop ");
    EXPECT_EQ(namesOf("cactus"), "plant ");
    EXPECT_EQ(namesOf("sand"), "falling ");
    EXPECT_EQ(namesOf("chest"), "container ");
    EXPECT_EQ(namesOf("stone"), "");
}

}  // namespace
}  // namespace terrane::world
