// The layers that slabs skip, and that the blocks stay the same.
#include "terrane/gen/cpu/slab_ranges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include "terrane/gen/generators/catalogue.h"
#include "tests/gen/pass_runner.h"
#include "tests/gen/random_graph.h"
#include "tests/support/default_heights.h"

namespace terrane::gen {
namespace {

using Way = SlabRun::Way;

// The last pass runs over heights 50 to 65 that rise along x, with blocks of a pass before it.
class SlabRangesTest : public testing::Test {
  protected:
    std::vector<SlabRun> run(const std::function<void(Pass&, Field<Int>)>& write) {
        runner_ = std::make_unique<PassRunner>(build([&](GeneratorBuilder& g) {
            const auto height = g.field<Int>("height");
            g.pass2D("height", [&](Pass& p) { p.set(height, p.x()); });
            g.pass3D("before", [](Pass&) {});
            g.pass3D("ground", [&](Pass& p) { write(p, height); });
        }));
        for (std::size_t lane = 0; lane < kTileLanes; ++lane)
            runner_->fields[0][lane] = bitsOf(50 + static_cast<std::int32_t>(lane % 16));
        runner_->blocks = std::make_unique<BlockArray>(before_);
        const auto whole = runner_->run3D(2, false);
        blocks_ = runner_->run3D(2);
        EXPECT_TRUE(*whole == *blocks_) << "not the blocks of the whole pass";
        return runner_->slabs();
    }
    int layers(const std::vector<SlabRun>& slabs, Way way) {
        int count = 0;
        for (const SlabRun& s : slabs) count += s.way == way ? s.count : 0;
        return count;
    }

    BlockArray before_{};
    std::unique_ptr<PassRunner> runner_;
    std::unique_ptr<BlockArray> blocks_;
};

TEST_F(SlabRangesTest, LayersAboveAndBelowAllGroundAreFilled) {
    const auto slabs = run([](Pass& p, Field<Int> height) {
        p.setBlock(select(p.z() <= p.read(height), p.block("stone"), p.block("air")));
    });
    EXPECT_GE(layers(slabs, Way::Filled), 232);
    EXPECT_LE(layers(slabs, Way::Short), 24);
    EXPECT_EQ((*blocks_)[50 * kTileLanes], 1);
    EXPECT_EQ((*blocks_)[51 * kTileLanes], 0);
}

TEST_F(SlabRangesTest, LayersThatAPassDoesNotChangeAreCopied) {
    for (std::size_t k = 0; k < before_.size(); ++k) before_[k] = static_cast<std::uint16_t>(k % 3);
    const auto slabs = run([](Pass& p, Field<Int> height) {
        p.if_(p.z() == p.read(height), [&] { p.setBlock(p.block("water")); });
    });
    EXPECT_GE(layers(slabs, Way::Copied), 224);
}

TEST_F(SlabRangesTest, LayersThatAreAlikeAreComputedOnce) {
    const auto slabs = run([](Pass& p, Field<Int> height) {
        const Block inside = select(p.read(height) > 55, p.block("stone"), p.block("dirt"));
        p.setBlock(select(p.z() < 40, inside, p.block("air")));
    });
    EXPECT_GE(layers(slabs, Way::Repeated), 36);
}

// A branch that no voxel of the slab takes is gone, with its noise.
TEST_F(SlabRangesTest, ShortPassesHaveFewerInstructions) {
    const auto slabs = run([](Pass& p, Field<Int> height) {
        Var<Block> block = p.var(p.block("air"));
        p.if_(p.z() < p.read(height), [&] {
            const Bool isRock = p.perlin3D("rock", 8, {1.0f}) > 0.0f;
            block = select(isRock, p.block("stone"), p.block("dirt"));
        });
        p.setBlock(block);
    });
    std::size_t fewest = 100, most = 0;
    for (const SlabRun& s : slabs) {
        if (s.way != Way::Short) continue;
        fewest = std::min(fewest, s.instructions);
        most = std::max(most, s.instructions);
    }
    EXPECT_LT(fewest, most);
    EXPECT_EQ(layers(slabs, Way::Whole), 0);
}

// Conditions on layers of the pass before are decided where these layers are one block.
TEST_F(SlabRangesTest, BlocksOfThePassBeforeAreLookedAt) {
    std::fill(before_.begin(), before_.end(), std::uint16_t{2});
    before_[40 * 256 + 255] = 1;
    const auto slabs = run([](Pass& p, Field<Int>) {
        const Bool isStone =
            p.blockHere() == p.block("stone") || p.blockInColumn(p.z() - 70) == p.block("stone");
        p.setBlock(select(isStone, p.block("air"), p.block("water")));
    });
    EXPECT_GE(layers(slabs, Way::Filled), 240);
    EXPECT_EQ((*blocks_)[40 * 256 + 255], 0);
    EXPECT_EQ((*blocks_)[110 * 256 + 255], 0);
}

// More kinds of slabs than there is room for: the whole pass runs.
TEST_F(SlabRangesTest, PassesOfTooManyKindsRunWhole) {
    constexpr int kSteps = 20, kKinds = (kSteps + 1) * (kSteps + 1);
    PassRunner runner(build([](GeneratorBuilder& g) {
        const auto a = g.field<Int>("a"), b = g.field<Int>("b");
        g.pass2D("fields", [&](Pass& p) {
            p.set(a, p.x());
            p.set(b, p.y());
        });
        g.pass3D("ground", [&](Pass& p) {
            Var<Int> sum = p.var(p.z());
            for (int k = 0; k < kSteps; ++k) {
                p.if_(p.read(a) > k, [&] { sum = Int(sum) * 3 + 1; });
                p.if_(p.read(b) > k, [&] { sum = Int(sum) * 5 + 1; });
            }
            p.setBlock(Block(static_cast<Int>(sum)));
        });
    }));
    const PassGraph& ground = runner.graph.passes[1];
    const VoxelPass pass(ground, runner.graph.noises);
    int shortRuns = 0;
    for (int kind = 0; kind < kKinds; ++kind) {
        runner.fields[0].fill(bitsOf(kind / (kSteps + 1)));
        runner.fields[1].fill(bitsOf(kind % (kSteps + 1)));
        const auto whole = runner.run3D(ground, pass, false);
        ASSERT_TRUE(*whole == *runner.run3D(ground, pass)) << "kind " << kind;
        const int wholeLayers = layers(runner.slabs(), Way::Whole);
        ASSERT_TRUE(wholeLayers == 0 || wholeLayers == 256);
        shortRuns += wholeLayers == 0;
    }
    EXPECT_GT(shortRuns, 0);
    EXPECT_LE(shortRuns, 256);
}

TEST(ShortPasses, OfRandomGraphsGiveTheBlocksOfTheWholeOnes) {
    int shortLayers = 0;
    for (std::uint32_t seed = 5000; seed < 5000 + kRandomCases / 4; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        PassRunner runner(RandomGraph(seed, true).take());
        RandomGraph::fillInputs(runner, seed);
        // Fields that vary little decide more.
        for (std::size_t f = 0; f < runner.fields.size() && seed % 2 == 0; ++f) {
            for (std::size_t lane = 1; lane < kTileLanes; ++lane)
                runner.fields[f][lane] = runner.fields[f][lane % 2];
        }
        const auto whole = runner.run3D(0, false);
        const auto blocks = runner.run3D(0);
        ASSERT_TRUE(*whole == *blocks);
        for (const SlabRun& s : runner.slabs()) shortLayers += s.way == SlabRun::Way::Whole ? 0 : s.count;
        for (int z = 0; z < world::kChunkHeight; ++z) {
            const std::uint16_t* layer = blocks->layer(z);
            const auto [low, high] = std::minmax_element(layer, layer + kTileLanes);
            ASSERT_TRUE(runner.layers().range(z) == (BlockRange{*low, *high})) << "layer " << z;
        }
    }
    EXPECT_GT(shortLayers, 0);
}

// The report that `terrane generate --explain` prints.
TEST(PassReport, CountsTheLayersOfEvery3DPass) {
    const Generator generator(makeGenerator("overworld", contentBlocks()).value(), kTestSeed);
    std::vector<PassReport> reports;
    generator.generate({3, 4}, reports);
    ASSERT_EQ(reports.size(), 2u);
    for (const PassReport& report : reports) {
        int layers = 0, isFilled = 0;
        for (const SlabRun& slab : report.slabs) {
            layers += slab.count;
            isFilled += slab.way == Way::Filled ? slab.count : 0;
            EXPECT_LE(slab.instructions, report.wholeInstructions);
        }
        EXPECT_EQ(layers, world::kChunkHeight);
        EXPECT_GT(isFilled, world::kChunkHeight / 4) << "there is mostly air above the ground";
    }
}

// Rock and sky of any height are few slabs.
TEST(PassReport, OfATallWorldHasFewSlabs) {
    const world::Heights tallest = {world::kLowestBottom, world::kHighestTop};
    const Generator generator(makeGenerator("flat", contentBlocks(), {0, tallest}).value(), kTestSeed);
    std::vector<PassReport> reports;
    generator.generate({3, 4}, reports);
    ASSERT_EQ(reports.size(), 1u);
    int layers = 0, isFilled = 0;
    for (const SlabRun& slab : reports[0].slabs) {
        layers += slab.count;
        isFilled += slab.way == Way::Filled ? slab.count : 0;
    }
    EXPECT_EQ(layers, tallest.layers());
    EXPECT_GT(isFilled, tallest.layers() - 32);
    EXPECT_LE(reports[0].slabs.size(), 32u);
}

}  // namespace
}  // namespace terrane::gen
