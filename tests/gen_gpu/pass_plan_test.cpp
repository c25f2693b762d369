#include "terrane/gen_gpu/pass_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "terrane/gen/generator.h"
#include "terrane/gen/generators/catalogue.h"
#include "tests/world/content_blocks.h"

namespace terrane::gen_gpu {
namespace {

using gen::Float;
using gen::Pass;
using world::ChunkPos;

// Two fields, each made from the one before and its neighbors, then blocks from the last field's neighbors.
gen::GeneratorGraph chainOfReads() {
    static const world::BlockRegistry blocks;
    gen::GeneratorBuilder g("chain", blocks);
    const auto first = g.field<Float>("first"), second = g.field<Float>("second");
    g.pass2D("first", [&](Pass& p) { p.set(first, Float(p.x())); });
    g.pass2D("second", [&](Pass& p) { p.set(second, p.readAt(first, {1, 0})); });
    g.pass3D("blocks", [&](Pass& p) {
        p.setBlock(select(p.readAt(second, {0, 1}) < Float(p.z()), p.block("air"), gen::Block(1)));
    });
    return *g.finish();
}

TEST(PassPlan, ReadsWidenTheAreaRingByRing) {
    const PassCounts counts = neededPasses(chainOfReads(), {{0, 0}});
    EXPECT_EQ(counts.size(), 25u);
    EXPECT_EQ(counts.at({0, 0}), 3);
    EXPECT_EQ(counts.at({1, -1}), 2) << "the blocks read the second field around";
    EXPECT_EQ(counts.at({2, 2}), 1) << "which reads the first one around";
}

TEST(PassPlan, NeighborsShareTheirRings) {
    EXPECT_EQ(neededPasses(chainOfReads(), {{0, 0}, {1, 0}}).size(), 30u);
}

TEST(PassPlan, WithoutReadsNothingButTheChunkIsNeeded) {
    static const world::BlockRegistry blocks;
    gen::GeneratorBuilder g("plain", blocks);
    g.pass3D("blocks", [&](Pass& p) { p.setBlock(gen::Block(1)); });
    const PassCounts counts = neededPasses(*g.finish(), {{5, 5}});
    EXPECT_EQ(counts.size(), 1u);
    EXPECT_EQ(counts.at({5, 5}), 1);
}

TEST(PassPlan, NeighborsAreOfTheSameLevel) {
    const PassCounts counts = neededPasses(chainOfReads(), {{0, 0, 3}, {0, 0, 1}});
    EXPECT_EQ(counts.size(), 50u);
    EXPECT_EQ(counts.at({2, 2, 3}), 1);
    EXPECT_EQ(counts.at({2, 2, 1}), 1);
    EXPECT_FALSE(counts.contains({0, 0, 0}));
}

// The arithmetic of kSlots in gpu_generator.h.
TEST(PassPlan, OverworldNeedsFourRings) {
    const auto overworld = gen::makeGenerator("overworld", contentBlocks());
    ASSERT_TRUE(overworld) << overworld.error().message;
    std::vector<ChunkPos> wanted;
    for (int k = 0; k < 64; ++k) wanted.push_back({k % 8, k / 8});
    EXPECT_EQ(neededPasses(*overworld, wanted).size(), 256u);
    EXPECT_EQ(overworld->fields.size(), 15u);
    const auto is3D = [](const gen::PassGraph& pass) { return pass.is3D; };
    EXPECT_EQ(std::count_if(overworld->passes.begin(), overworld->passes.end(), is3D), 2);
}

TEST(PassPlan, AroundTheEdgeCoordinatesWrap) {
    const auto around = gen::chunksAround({world::kMaxChunk, world::kMinChunk});
    EXPECT_EQ(around[4], (ChunkPos{world::kMaxChunk, world::kMinChunk}));
    EXPECT_EQ(around[5], (ChunkPos{world::kMinChunk, world::kMinChunk}));
    EXPECT_EQ(around[1], (ChunkPos{world::kMaxChunk, world::kMaxChunk}));
    EXPECT_EQ(std::set(around.begin(), around.end()).size(), 9u);
}

// Level k has 2^k times fewer chunks along an axis.
TEST(PassPlan, AroundTheEdgeOfHigherLevelsCoordinatesWrapToo) {
    const auto around = gen::chunksAround({world::kMaxChunk >> 3, 0, 3});
    EXPECT_EQ(around[4], (ChunkPos{world::kMaxChunk >> 3, 0, 3}));
    EXPECT_EQ(around[5], (ChunkPos{world::kMinChunk >> 3, 0, 3}));
    EXPECT_EQ(around[1], (ChunkPos{world::kMaxChunk >> 3, -1, 3}));
}

}  // namespace
}  // namespace terrane::gen_gpu
