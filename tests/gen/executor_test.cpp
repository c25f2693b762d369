#include "terrane/gen/cpu/executor.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "tests/gen/noise_reference.h"
#include "tests/gen/pass_runner.h"
#include "tests/support/default_heights.h"

namespace terrane::gen {
namespace {

TEST(Executor, ResultsComeInTheOrderOfTheProgramsFields) {
    PassRunner runner([](GeneratorBuilder& g) {
        const auto a = g.field<Int>("a"), b = g.field<Int>("b"), c = g.field<Int>("c");
        const auto d = g.field<Bool>("d");
        g.pass2D("all", [&](Pass& p) {
            p.set(d, (p.x() & 1) == 0);
            p.set(c, p.x() * 100 + p.y());
            p.set(a, p.y());
            p.set(b, Int(-7));  // the same in every column
        });
    });
    runner.chunk = {-1, 3};
    const std::vector<ColumnValues> results = runner.run2D(0);
    ASSERT_EQ(results.size(), 4u);
    for (std::int32_t lane = 0; lane < kTileLanes; ++lane) {
        const std::int32_t x = -16 + lane % 16, y = 48 + lane / 16;
        const auto at = static_cast<std::size_t>(lane);
        EXPECT_EQ(asInt(results[0][at]), y);
        EXPECT_EQ(asInt(results[1][at]), -7);
        EXPECT_EQ(asInt(results[2][at]), x * 100 + y);
        EXPECT_EQ(results[3][at], bitsOf((x & 1) == 0));
    }
}

TEST(Executor, OneValueMayBeSeveralFields) {
    PassRunner runner([](GeneratorBuilder& g) {
        const auto a = g.field<Int>("a"), b = g.field<Int>("b");
        g.pass2D("both", [&](Pass& p) {
            p.set(a, p.x() * p.y());
            p.set(b, p.y() * p.x());
        });
    });
    const std::vector<ColumnValues> results = runner.run2D(0);
    EXPECT_EQ(results[0], results[1]);
    EXPECT_EQ(asInt(results[0][16 * 3 + 5]), 15);
}

// A pass that passes on what it read, what it stands at, and a block wider than a block id.
TEST(Executor, BlocksAreTheLowerHalfOfTheValue) {
    PassRunner runner([](GeneratorBuilder& g) {
        g.pass3D("z", [](Pass& p) { p.setBlock(Block(p.z())); });
        g.pass3D("x", [](Pass& p) { p.setBlock(Block(p.x())); });
        g.pass3D("same", [](Pass&) {});
    });
    runner.chunk = {0x5432, -1};
    const auto z = runner.run3D(0), x = runner.run3D(1);
    EXPECT_EQ((*z)[0], 0);
    EXPECT_EQ((*z)[255 * 256 + 17], 255);
    EXPECT_EQ((*x)[100 * 256 + 3], 0x4323);
    runner.blocks = std::make_unique<BlockArray>();
    for (std::size_t k = 0; k < runner.blocks->size(); ++k)
        (*runner.blocks)[k] = static_cast<std::uint16_t>(k * 40503);
    EXPECT_TRUE(*runner.run3D(2) == *runner.blocks);
}

// Small after large after small: rows and windows of the pass before must not show.
TEST(Executor, OneExecutorRunsPassAfterPass) {
    const GeneratorGraph g = build([](GeneratorBuilder& builder) {
        const auto f = builder.field<Int>("f"), h = builder.field<Int>("h");
        builder.pass2D("small", [&](Pass& p) { p.set(f, p.x() + 1); });
        builder.pass2D("large", [&](Pass& p) {
            Int sum = 0;
            for (int k = -16; k <= 16; ++k) sum = sum + p.readAt(f, {k, -k}) * (k + 20);
            p.set(h, sum + Int(p.voronoi2D("v", 9, 2).distance * 0.0f));
        });
        builder.pass3D("blocks", [&](Pass& p) { p.setBlock(Block(p.read(h) + p.z())); });
    });
    PassRunner shared(g);
    for (int round = 0; round < 3; ++round) {
        for (const ChunkPos chunk : kPlaces) {
            PassRunner fresh(g);
            fresh.chunk = shared.chunk = chunk;
            fresh.around.resize(1);
            for (std::size_t n = 0; n < 9; ++n) {
                for (std::size_t lane = 0; lane < kTileLanes; ++lane) {
                    fresh.around[0][n][lane] =
                        static_cast<Bits>(n * 1000 + lane * 7 + static_cast<std::size_t>(round));
                }
            }
            fresh.fields[0] = fresh.around[0][4];
            shared.around = fresh.around;
            shared.fields = fresh.fields;
            ASSERT_EQ(shared.run2D(0), fresh.run2D(0));
            ASSERT_EQ(shared.run2D(1), fresh.run2D(1));
            ASSERT_TRUE(*shared.run3D(2) == *fresh.run3D(2));
        }
    }
}

// The noise follows the layers though the branch skips some of them.
TEST(Executor, SolidNoiseInABranchThatSkipsLayers) {
    PassRunner runner([](GeneratorBuilder& g) {
        g.pass3D("noise", [](Pass& p) {
            Var<Int> v = p.var(Int(0));
            p.if_((p.z() & 7) == 3 || (p.z() > 100 && p.z() < 110) || p.z() > 250, [&] {
                v = Int(p.perlin3D("n", 5, {1.0f, 0.5f}) * 8192.0f);
            });
            p.setBlock(Block(static_cast<Int>(v)));
        });
    });
    runner.chunk = {-3, 8};
    const NoiseCall& call = runner.graph.noises[0];
    const auto blocks = runner.run3D(0);
    for (std::int32_t z = 0; z < world::kChunkHeight; ++z) {
        const bool taken = z % 8 == 3 || (z > 100 && z < 110) || z > 250;
        for (std::int32_t lane = 0; lane < kTileLanes; lane += 5) {
            const float v =
                reference::perlin3D(call, PassRunner::noiseSeed(0), {-48 + lane % 16, 128 + lane / 16, z});
            const std::int32_t want = taken ? static_cast<std::int32_t>(v * 8192.0f) : 0;
            ASSERT_EQ((*blocks)[static_cast<std::size_t>(z * kTileLanes + lane)],
                      static_cast<std::uint16_t>(want));
        }
    }
}

}  // namespace
}  // namespace terrane::gen
