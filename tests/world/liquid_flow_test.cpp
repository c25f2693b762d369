#include "terrane/world/changes/liquid_flow.h"

#include <algorithm>
#include <array>

#include "terrane/world/character.h"
#include "tests/support/default_heights.h"
#include "tests/world/flow_world.h"

namespace terrane::world {
namespace {

class LiquidFlow : public testing::Test, protected FlowWorld {
  protected:
    LiquidFlow() { addChunks(-1, -1, 1, 1); }
    // A row of stone along x at y = 3 and y = 5, so that water at y = 4 has one way.
    void ditch(int x0, int x1, int z) {
        for (int x = x0; x <= x1; ++x)
            for (const int y : {3, 5}) set({x, y, z}, "stone");
    }
};

TEST_F(LiquidFlow, SpreadsSevenBlocksOnGround) {
    set({0, 4, 1}, "water");
    settle();
    EXPECT_EQ(row(-9, 9, 4, 1), "..7654321s1234567..");
    EXPECT_EQ(row(-9, 9, 7, 1), ".....765434567.....");
}

TEST_F(LiquidFlow, FallsBeforeItSpreads) {
    for (int x = 0; x < 3; ++x) set({x, 4, 9}, "stone");
    ditch(-1, 12, 10);
    set({-1, 4, 10}, "stone");
    set({0, 4, 10}, "water");
    settle();
    EXPECT_EQ(row(-1, 5, 4, 10), "#s123..") << "over the edge it spreads no farther";
    for (int z = 2; z < 10; ++z) EXPECT_EQ(at({3, 4, z}), 'f') << z;
    EXPECT_EQ(at({3, 4, 1}), 'f');
    EXPECT_EQ(row(3, 11, 4, 1), "f1234567.") << "from the foot of the fall as from a source";
    EXPECT_EQ(at({4, 4, 5}), '.') << "a fall stays narrow";
}

TEST_F(LiquidFlow, RunsDryWithoutItsSource) {
    for (int x = 0; x < 3; ++x) set({x, 4, 9}, "stone");
    set({0, 4, 10}, "water");
    settle();
    clear({0, 4, 10});
    EXPECT_LT(settle(), 40);
    world.forEachChunk([&](ChunkPos, const ChunkPtr& chunk) {
        for (int i = 0; i < kBlocksPerChunk; ++i) {
            ASSERT_NE(chunk->block(static_cast<BlockIndex>(i)), water);
            ASSERT_EQ(chunk->blockState(static_cast<BlockIndex>(i)), 0);
        }
    });
}

TEST_F(LiquidFlow, TwoSourcesMakeOneBetweenThem) {
    ditch(-1, 6, 1);
    set({-1, 4, 1}, "stone");
    set({3, 4, 1}, "stone");
    set({0, 4, 1}, "water");
    set({2, 4, 1}, "water");
    settle();
    EXPECT_EQ(row(0, 2, 4, 1), "sss");
    clear({1, 4, 1});
    settle();
    EXPECT_EQ(row(0, 2, 4, 1), "sss") << "a pond fills up again";
}

TEST_F(LiquidFlow, TwoSourcesOverAFallMakeNone) {
    set({0, 4, 9}, "stone");
    set({2, 4, 9}, "stone");
    set({0, 4, 10}, "water");
    set({2, 4, 10}, "water");
    settle();
    EXPECT_EQ(at({1, 4, 10}), '1');
    EXPECT_EQ(at({1, 4, 9}), 'f');
}

TEST_F(LiquidFlow, DoesNotSpreadOnAPool) {
    for (int x = -4; x <= 4; ++x)
        for (int y = 0; y <= 8; ++y) putBlock(world, {x, y, 1}, water);
    for (const BlockPos side : {BlockPos{-1, 4, 5}, {1, 4, 5}, {0, 3, 5}, {0, 5, 5}}) set(side, "stone");
    set({0, 4, 5}, "water");
    settle();
    EXPECT_EQ(at({0, 4, 2}), 'f');
    EXPECT_EQ(at({1, 4, 2}), '.');
    EXPECT_EQ(at({0, 4, 1}), 's');
}

TEST_F(LiquidFlow, WashesAwayPlantsAndTorchesOnly) {
    set({1, 4, 0}, "grass");
    set({1, 4, 1}, "poppy");
    set({-1, 4, 1}, "torch");
    set({0, 5, 1}, "oak_fence");
    set({0, 2, 1}, "stone");
    applyChange(world, contentBlocks(), {0, 3, 1}, SetBlock{contentBlock("ladder"), 2}, edits);
    ASSERT_EQ(world.block({0, 3, 1}), contentBlock("ladder"));
    set({0, 4, 1}, "water");
    settle();
    EXPECT_EQ(at({1, 4, 1}), '1');
    EXPECT_EQ(at({-1, 4, 1}), '1');
    EXPECT_EQ(world.block({0, 5, 1}), contentBlock("oak_fence"));
    EXPECT_EQ(world.block({0, 3, 1}), contentBlock("ladder"));
}

TEST_F(LiquidFlow, GeneratedWaterStaysUntilABlockBesideItChanges) {
    putBlock(world, {0, 4, 5}, water);
    EXPECT_EQ(tick(), 0u);
    set({3, 4, 5}, "stone");
    EXPECT_EQ(tick(), 0u) << "not beside it";
    set({1, 4, 5}, "stone");
    settle();
    EXPECT_EQ(at({0, 4, 1}), 'f');
    EXPECT_EQ(at({-1, 4, 5}), '1');
}

TEST_F(LiquidFlow, FlowsIntoWhatIsDug) {
    for (int x = 0; x < 6; ++x)
        for (int z = 1; z < 4; ++z)
            for (int y = 3; y < 6; ++y) putBlock(world, {x, y, z}, contentBlock("stone"));
    putBlock(world, {0, 4, 3}, water);
    clear({1, 4, 3});
    clear({2, 4, 3});
    settle();
    EXPECT_EQ(row(0, 3, 4, 3), "s12#");
    clear({2, 4, 2});
    settle();
    EXPECT_EQ(row(0, 3, 4, 3), "s12#");
    EXPECT_EQ(at({2, 4, 2}), 'f');
}

TEST_F(LiquidFlow, NothingLeavesTheWorld) {
    putBlock(world, {-11, 4, 0}, water);
    putBlock(world, {5, 4, 255}, water);
    clear({-12, 4, 0});
    set({5, 4, 254}, "stone");
    settle();
    EXPECT_EQ(at({-12, 4, 0}), '1');
    EXPECT_EQ(at({6, 4, 255}), '1');
    EXPECT_EQ(at({6, 4, 1}), 'f');
}

TEST_F(LiquidFlow, WaitsForChunksThatAreNotLoaded) {
    set({30, 4, 1}, "water");
    settle();
    EXPECT_EQ(at({30, 4, 1}), 's') << "two blocks from the border: it is not looked at";
    EXPECT_EQ(at({29, 4, 1}), '.');
    addChunks(2, -1, 2, 1);
    settle();
    EXPECT_EQ(row(29, 37, 4, 1), "1s1234567");
}

TEST(LiquidDepth, FallsAThousandBlocks) {
    FlowWorld flow({-512, 768});
    flow.addChunks(-1, -1, 1, 1);
    for (const BlockPos side : {BlockPos{7, 8, 600}, {9, 8, 600}, {8, 7, 600}, {8, 9, 600}})
        flow.set(side, "stone");
    flow.set({8, 8, 600}, "water");
    EXPECT_GE(flow.settle(2000), 1000) << "a block in a tick";
    const auto isFall = [&](int x) {
        for (int z = 599; z > -512; --z)
            if (flow.at({x, 8, z}) != 'f') return false;
        return true;
    };
    EXPECT_TRUE(isFall(8));
    EXPECT_EQ(flow.row(7, 9, 8, 500), ".f.") << "narrow";
    EXPECT_EQ(flow.row(1, 15, 8, -511), "7654321f1234567");
    flow.clear({8, 8, 600});
    flow.settle(2000);
    EXPECT_EQ(flow.row(1, 15, 8, -511), "...............");
    EXPECT_EQ(flow.at({8, 8, 0}), '.');
}

TEST(LiquidDepth, WaitsForWhatIsNotMade) {
    FlowWorld flow({-64, 64});
    flow.addChunks(-1, -1, 1, 1);
    Chunk whole = *flow.world.maybeChunkAt({0, 0});
    auto shallow = std::make_shared<Chunk>(whole);
    shallow->unmakeBelow(0);
    flow.world.insert({0, 0}, shallow);
    flow.set({8, 8, 20}, "water");
    flow.settle();
    EXPECT_EQ(flow.at({8, 8, 3}), 'f');
    EXPECT_EQ(flow.at({13, 8, 0}), '.') << "it does not spread on ground that is not there";
    flow.world.makeDeeper({0, 0}, whole);
    flow.settle();
    EXPECT_EQ(flow.at({8, 8, -63}), 'f');
    EXPECT_EQ(flow.at({13, 8, 0}), '.');
    EXPECT_EQ(flow.at({13, 8, -63}), '4') << "as without the pause";
}

TEST(LiquidDepth, SandOnWhatIsNotMadeFallsOnWhenItIs) {
    FlowWorld flow({-64, 64});
    flow.addChunks(0, 0, 0, 0);
    putBlock(flow.world, {1, 1, 0}, contentBlock("sand"));  // an overhang that was generated
    const Chunk whole = *flow.world.maybeChunkAt({0, 0});
    auto shallow = std::make_shared<Chunk>(whole);
    shallow->unmakeBelow(0);
    flow.world.insert({0, 0}, shallow);
    for (const int z : {20, 21}) flow.set({8, 8, z}, "sand");
    flow.set({8, 8, 22}, "gravel");
    EXPECT_EQ(flow.settle(), 0);
    EXPECT_EQ(flow.world.block({8, 8, 0}), contentBlock("sand")) << "it waits";
    flow.world.makeDeeper({0, 0}, whole);
    FlowRecord record;
    flowLiquids(flow.world, contentBlocks(), chunksWithin({0, 0}, 1), flow.edits, {nullptr, &record});
    EXPECT_EQ(flow.world.block({8, 8, -63}), contentBlock("sand"));
    EXPECT_EQ(flow.world.block({8, 8, -62}), contentBlock("sand"));
    EXPECT_EQ(flow.world.block({8, 8, -61}), contentBlock("gravel"));
    EXPECT_EQ(flow.world.block({8, 8, 0}), kAir);
    EXPECT_EQ(flow.world.blockState({8, 8, -63}), 0) << "as without the pause";
    EXPECT_EQ(flow.world.block({1, 1, 0}), contentBlock("sand"));
    EXPECT_EQ(flow.settle(), 0);
}

TEST_F(LiquidFlow, SandFallsThroughFlowingWaterAndLandsOnce) {
    for (int x = 0; x < 2; ++x) set({x, 4, 9}, "stone");
    set({0, 4, 10}, "water");
    settle();
    ASSERT_EQ(at({2, 4, 5}), 'f');
    for (const auto name : {"sand", "gravel"}) set({2, 4, 8}, name);
    settle();
    EXPECT_EQ(world.block({2, 4, 1}), contentBlock("sand"));
    EXPECT_EQ(world.block({2, 4, 2}), contentBlock("gravel"));
    for (int z = 3; z < 10; ++z) EXPECT_EQ(at({2, 4, z}), 'f') << "the fall closes again";
    EXPECT_EQ(at({3, 4, 3}), '1') << "and spreads from where it ends now";
    EXPECT_EQ(at({3, 4, 1}), 'f');
}

TEST_F(LiquidFlow, SandComesDownWhenTheWaterUnderItChanges) {
    putBlock(world, {0, 4, 4}, water);
    putBlock(world, {0, 4, 5}, contentBlock("sand"));
    clear({0, 4, 4});
    EXPECT_EQ(world.block({0, 4, 1}), contentBlock("sand"));
}

TEST_F(LiquidFlow, UndoOfASourceLetsItRunDry) {
    BlockRecorder recorder;
    applyChange(world, contentBlocks(), {0, 4, 1}, SetBlock{water, kUnsettled}, edits, &recorder);
    settle();
    restoreBlocks(world, contentBlocks(), recorder.take(), edits);
    settle();
    EXPECT_EQ(row(-9, 9, 4, 1), "...................");
}

TEST_F(LiquidFlow, ARestoredCellThatFlowsIsLookedAt) {
    const PlacedBlock flowing{{0, 4, 1}, {water, 3, nullptr}};
    restoreBlocks(world, contentBlocks(), std::span(&flowing, 1), edits);
    EXPECT_EQ(at({0, 4, 1}), '3');
    settle();
    EXPECT_EQ(at({0, 4, 1}), '.');
}

// Events cover all changes, so that they are saved, and the chunk beyond a border.
TEST_F(LiquidFlow, EventsTellOfEveryChange) {
    putBlock(world, {-1, 4, 1}, water);
    edits.clear();
    set({0, 4, 1}, "stone");
    EXPECT_TRUE(std::ranges::count(edits, BlockEdit{{-1, 4, 1}, water, water}) == 1) << "it is unsettled now";
    edits.clear();
    tick();
    EXPECT_TRUE(std::ranges::count(edits, BlockEdit{{-2, 4, 1}, kAir, water}) == 1);
    EXPECT_TRUE(std::ranges::count(edits, BlockEdit{{-1, 4, 1}, water, water}) >= 1);
}

TEST_F(LiquidFlow, WhatHasSettledCostsNothing) {
    set({0, 4, 1}, "water");
    settle();
    tick();
    world.forEachChunk([](ChunkPos, const ChunkPtr& chunk) {
        for (int section = 0; section < kSectionsPerChunk; ++section)
            for (const std::uint16_t state : chunk->blockStates(section).palette())
                EXPECT_EQ(state & kUnsettled, 0);
    });
}

TEST_F(LiquidFlow, WhatIsMoreThanATickTakesGoesOnInTheNext) {
    std::size_t count = 0;
    for (int y = -14; y < 30; y += 2)
        for (int x = -14; x < 30; x += 2)
            for (int z = 1; z < 13; z += 3, ++count) set({x, y, z}, "water");
    ASSERT_GT(count, kMaxFlowingCells);
    EXPECT_EQ(tick(), kMaxFlowingCells);
    settle();
    for (int y = -14; y < 29; ++y)
        for (int x = -14; x < 29; ++x) ASSERT_NE(at({x, y, 1}), '.') << x << ' ' << y;
    for (int x = -14; x < 30; x += 2)
        EXPECT_EQ(at({x, 28, 9}), 'f') << "under the last source of each column";
}

TEST_F(LiquidFlow, HeightsFollowLevels) {
    set({0, 4, 1}, "water");
    settle();
    const auto height = [&](int x, int z) { return liquidHeight(world, contentBlocks(), {x, 4, z}); };
    EXPECT_DOUBLE_EQ(height(0, 1), 0.875);
    EXPECT_DOUBLE_EQ(height(4, 1), 0.4375);
    EXPECT_DOUBLE_EQ(height(8, 1), 0);
    EXPECT_TRUE(isInLiquid(world, contentBlocks(), {0.5, 4.5, 1.95})) << "a source's cell counts as full";
    EXPECT_TRUE(isInLiquid(world, contentBlocks(), {4.5, 4.5, 1.4}));
    EXPECT_FALSE(isInLiquid(world, contentBlocks(), {4.5, 4.5, 1.5}));
    set({0, 4, 2}, "water");
    settle();
    EXPECT_DOUBLE_EQ(height(0, 1), 1);
    EXPECT_DOUBLE_EQ(height(1, 1), 1) << "it falls from level 1 above";
}

// Cells that never settle, as in chunks that are unloaded, must not fill the memory.
TEST(FlowRecord, ForgetsCellsThatAreGone) {
    FlowWorld flow;
    flow.addChunks(-1, -1, 1, 1);
    FlowRecord record;
    for (std::size_t k = 0; k < FlowRecord::kMaxCauses; ++k)
        record.causes[{static_cast<std::int32_t>(k) + 1000, 0, 5}] = 7;  // where no chunk is
    const std::size_t before = flow.edits.size();
    flow.set({3, 3, 1}, "water");
    record.note(flow.world, contentBlocks(), std::span(flow.edits).subspan(before), 9);
    EXPECT_EQ(record.causes.size(), 1u);
    EXPECT_EQ(record.causes.at({3, 3, 1}), 9u);
    (void)flowLiquids(flow.world, contentBlocks(), chunksWithin({0, 0}, 1), flow.edits, {nullptr, &record});
    EXPECT_FALSE(record.changes.contains(0));
    EXPECT_TRUE(record.changes.contains(9));
}

}  // namespace
}  // namespace terrane::world
