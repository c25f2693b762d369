// Random passes by the executor, on every instruction set, against plain recursion.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "terrane/gen/cpu/executor.h"
#include "tests/gen/pass_runner.h"
#include "tests/gen/random_graph.h"
#include "tests/gen/slow_evaluator.h"

namespace terrane::gen {
namespace {

// Values of the pass's fields in all columns.
std::vector<ColumnValues> expectedColumns(const PassRunner& runner) {
    const PassGraph& pass = runner.graph.passes[0];
    SlowEvaluator evaluator(runner, pass.graph);
    std::vector<ColumnValues> expected(pass.fields.size());
    for (std::size_t lane = 0; lane < kTileLanes; ++lane) {
        evaluator.moveTo(placeOf(runner.chunk, {}, lane));
        for (std::size_t k = 0; k < pass.fields.size(); ++k) {
            expected[k][lane] = evaluator.value(pass.fields[k].value);
        }
    }
    return expected;
}

void expectColumns(PassRunner& runner, const std::vector<ColumnValues>& expected) {
    const std::vector<ColumnValues> results = runner.run2D(0);
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const Type type = runner.graph.fields[runner.graph.passes[0].fields[k].field].type;
        for (std::size_t lane = 0; lane < kTileLanes; ++lane) {
            const Bits result = results[k][lane], want = expected[k][lane];
            const bool same = type == Type::Float ? sameFloat(result, want) : result == want;
            ASSERT_TRUE(same) << "result " << k << ", column " << lane << ": " << result << ", not " << want;
        }
    }
}

TEST(ExecutorRandom, Passes2D) {
    for (std::uint32_t seed = 0; seed < kRandomCases; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        PassRunner runner(RandomGraph(seed, false).take());
        RandomGraph::fillInputs(runner, seed);
        const std::vector<ColumnValues> expected = expectedColumns(runner);
        onEachTarget([&] { expectColumns(runner, expected); });
        if (HasFatalFailure()) return;
    }
}

// The bottom, the top and a few layers between: plain recursion for all of them would take long.
std::vector<int> someLayers(std::uint32_t seed, world::Heights heights) {
    std::mt19937 random(seed);
    std::vector<int> layers = {heights.bottom, heights.top - 1};
    for (int k = 0; k < 3; ++k)
        layers.push_back(heights.bottom +
                         static_cast<int>(random() % static_cast<std::uint32_t>(heights.layers())));
    return layers;
}

void expectLayers(const PassRunner& runner, const BlockArray& blocks, const std::vector<int>& layers) {
    const PassGraph& pass = runner.graph.passes[0];
    SlowEvaluator evaluator(runner, pass.graph);
    for (const int z : layers) {
        for (std::size_t lane = 0; lane < kTileLanes; ++lane) {
            world::BlockPos at = placeOf(runner.chunk, {}, lane);
            at.z = z;
            evaluator.moveTo(at);
            const auto want = static_cast<std::uint16_t>(evaluator.value(*pass.block));
            ASSERT_EQ(blocks.layer(z)[lane], want) << "layer " << z << ", column " << lane;
        }
    }
}

TEST(ExecutorRandom, Passes3D) {
    for (std::uint32_t seed = 1000; seed < 1000 + kRandomCases / 10; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        PassRunner runner(RandomGraph(seed, true).take());
        RandomGraph::fillInputs(runner, seed);
        std::unique_ptr<BlockArray> first;
        onEachTarget([&] {
            std::unique_ptr<BlockArray> blocks = runner.run3D(0);
            if (!first) {
                first = std::move(blocks);
                expectLayers(runner, *first, someLayers(seed, {}));
            } else {
                ASSERT_TRUE(*first == *blocks) << "not the blocks of the first instruction set";
            }
        });
        if (HasFatalFailure()) return;
    }
}

// With and without shortening.
TEST(ExecutorRandom, Passes3DOfAnyHeights) {
    for (std::uint32_t seed = 2000; seed < 2000 + kRandomCases / 5; ++seed) {
        const world::Heights heights = kSomeHeights[seed % kSomeHeights.size()];
        SCOPED_TRACE("seed " + std::to_string(seed) + ", " + world::describe(heights));
        PassRunner runner(RandomGraph(seed, true).take(heights));
        RandomGraph::fillInputs(runner, seed);
        const auto whole = runner.run3D(0, false), blocks = runner.run3D(0);
        ASSERT_TRUE(*whole == *blocks) << "not the blocks of the whole pass";
        ASSERT_NO_FATAL_FAILURE(expectLayers(runner, *blocks, someLayers(seed, heights)));
    }
}

}  // namespace
}  // namespace terrane::gen
