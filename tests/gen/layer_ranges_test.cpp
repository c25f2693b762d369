#include "terrane/gen/layer_ranges.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "tests/gen/pass_runner.h"

namespace terrane::gen {
namespace {

struct Certain {
    std::map<int, int> layers;  // z and block
    int sections = 0;           // that are one block throughout
};

// What is certain of a pass. No instruction runs: fields are 0 but where
// `heights` says.
Certain certainLayers(const std::function<void(Pass&, Field<Int>)>& write, const std::vector<int>& heights,
                      const std::uint16_t* blocks = nullptr) {
    const GeneratorGraph graph = build([&](GeneratorBuilder& g) {
        const auto height = g.field<Int>("height");
        g.pass2D("height", [&](Pass& p) { p.set(height, p.x()); });
        g.pass3D("before", [](Pass&) {});
        g.pass3D("ground", [&](Pass& p) { write(p, height); });
    });
    const Program program = compile(graph.passes[2], graph.noises);
    std::vector<Bits> arena(std::size_t{program.arenaRows} * kRowLanes);
    for (std::size_t k = 0; k < program.constants.size(); ++k) {
        std::fill_n(arena.begin() + static_cast<long>(k * kRowLanes), kRowLanes, program.constants[k]);
    }
    for (const Instruction& i : program.column) {
        if (i.op != Op::Field) continue;
        for (std::size_t lane = 0; lane < kTileLanes; ++lane)
            arena[std::size_t{i.dst.row} * kRowLanes + lane] = bitsOf(heights[lane % heights.size()]);
    }
    std::vector<NoiseKind> kinds;
    for (const NoiseCall& call : graph.noises) kinds.push_back(call.kind);
    LayerRanges ranges;
    ranges.begin(program, arena.data(), kinds, blocks);
    Certain certain;
    std::map<int, int>& layers = certain.layers;
    for (int z = 0; z < world::kChunkHeight; ++z) {
        if (const auto block = ranges.blockOfLayers(z, 1)) layers[z] = *block;
    }
    // Of several layers no more is certain than of each alone.
    for (int z = 0; z < world::kChunkHeight; z += world::kSectionSize) {
        const auto block = ranges.blockOfLayers(z, world::kSectionSize);
        for (int k = z; block && k < z + world::kSectionSize; ++k) {
            EXPECT_TRUE(layers.contains(k) && layers[k] == *block) << "layer " << k;
        }
        if (block) ++certain.sections;
    }
    return certain;
}

TEST(LayerRanges, AboveAndBelowAllGroundLayersAreCertain) {
    const auto [layers, sections] = certainLayers(
        [](Pass& p, Field<Int> height) {
            p.setBlock(select(p.z() <= p.read(height), p.block("stone"), p.block("air")));
        },
        {50, 60});
    EXPECT_EQ(layers.size(), 246u);
    EXPECT_EQ(sections, 15);
    EXPECT_EQ(layers.at(50), 1);
    EXPECT_FALSE(layers.contains(51) || layers.contains(60));
    EXPECT_EQ(layers.at(61), 0);
}

TEST(LayerRanges, ABranchThatAllOrNoColumnsTakeIsFollowed) {
    const auto [layers, sections] = certainLayers(
        [](Pass& p, Field<Int> height) {
            Var<Block> block = p.var(p.block("air"));
            p.if_(p.read(height) - p.z() >= 0, [&] {
                block = p.block("stone");
                p.if_(p.z() == 20 || p.z() == p.read(height), [&] { block = p.block("dirt"); });
            });
            p.setBlock(block);
        },
        {30, 31, 32});
    EXPECT_EQ(layers.size(), 253u);
    EXPECT_EQ(sections, 14);
    EXPECT_EQ(layers.at(20), 2);
    EXPECT_EQ(layers.at(29), 1);
    EXPECT_EQ(layers.at(33), 0);
}

TEST(LayerRanges, NoiseIsCertainOnlyWhereItDoesNotMatter) {
    const auto [layers, sections] = certainLayers(
        [](Pass& p, Field<Int> height) {
            Var<Block> block = p.var(p.block("air"));
            p.if_(p.z() < p.read(height), [&] {
                const Voronoi3D cells = p.voronoi3D("cells", 16, 2);
                const Bool isRock = p.perlin3D("rock", 8, {1.0f}) > 0.0f && cells.distance > 3.0f;
                block = select(isRock, p.block("stone"), p.block("dirt"));
            });
            p.setBlock(block);
        },
        {100});
    EXPECT_EQ(layers.size(), 156u);
    EXPECT_EQ(sections, 9);
    EXPECT_FALSE(layers.contains(99));
    EXPECT_EQ(layers.at(100), 0);
}

// Layers of the pass before that are one block are known, others not.
TEST(LayerRanges, BlocksOfThePassBeforeAreLookedAt) {
    const auto blocks = std::make_unique<BlockArray>();
    std::fill(blocks->begin(), blocks->end(), std::uint16_t{2});
    (*blocks)[40 * 256 + 255] = 1;
    const auto [layers, sections] = certainLayers(
        [](Pass& p, Field<Int>) {
            p.setBlock(select(p.z() < 100, p.blockHere(), p.blockInColumn(p.z() - 70)));
        },
        {0}, blocks->data());
    EXPECT_EQ(layers.size(), 254u);
    EXPECT_EQ(sections, 14) << "all but those of layers 40, 100 and 110";
    EXPECT_EQ(layers.at(39), 2);
    EXPECT_FALSE(layers.contains(40) || layers.contains(110));
}

// Sums wrap: nothing is known of one that may.
TEST(LayerRanges, SumsThatMayWrapAreNotCertain) {
    const auto [layers, sections] = certainLayers(
        [](Pass& p, Field<Int> height) {
            p.setBlock(select(p.read(height) + p.z() + 0x7FFFFFFF > 0, p.block("stone"), p.block("air")));
        },
        {-1, 1});
    EXPECT_TRUE(layers.empty() && sections == 0);
}

TEST(LayerRanges, AValueThatALoopMakesIsNotCertain) {
    const auto [layers, sections] = certainLayers(
        [](Pass& p, Field<Int> height) {
            Var<Int> n = p.var(p.z());
            p.while_([&] { return n > p.read(height); }, [&] { n = Int(n) - 3; });
            p.setBlock(select(n > 0, p.block("stone"), p.block("air")));
        },
        {10, 20});
    EXPECT_TRUE(layers.empty() && sections == 0);
}

}  // namespace
}  // namespace terrane::gen
