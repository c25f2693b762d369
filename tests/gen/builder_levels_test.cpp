// Recordings of a generator at other levels: positions, steps, noise that fades, reads by the nearest column.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/language/compounds.h"
#include "tests/gen/gen_fixture.h"
#include "tests/gen/noise_reference.h"

namespace terrane::gen {
namespace {

using testing::HasSubstr;

GeneratorGraph buildLevel(int level, const Write& write) {
    GeneratorBuilder builder("test", testBlocks(), level);
    write(builder);
    auto graph = builder.finish();
    EXPECT_TRUE(graph.has_value()) << (graph ? "" : graph.error().message);
    return graph ? std::move(*graph) : GeneratorGraph();
}

// The lowest layer of a chunk: 256 numbers of 16 bits.
std::vector<BlockId> numbersOf(const Generator& generator, ChunkPos pos) {
    std::vector<BlockId> ids = blocksOf(generator.generate(pos));
    ids.resize(256);
    return ids;
}

// By the block that stands for a column.
using Expected = std::function<std::int64_t(std::int64_t x, std::int64_t y)>;

void expectColumns(int level, const Write& write, const Expected& expected) {
    const Generator generator(buildLevel(level, write), kTestSeed);
    EXPECT_EQ(generator.level(), level);
    for (const ChunkPos pos : placesOf(level)) {
        const std::vector<BlockId> ids = numbersOf(generator, pos);
        for (std::int64_t k = 0; k < 256; ++k) {
            const std::int64_t x = ((std::int64_t{pos.x} * 16 + k % 16) << level) + (1 << level) / 2;
            const std::int64_t y = ((std::int64_t{pos.y} * 16 + k / 16) << level) + (1 << level) / 2;
            ASSERT_EQ(ids[static_cast<std::size_t>(k)], static_cast<BlockId>(expected(x, y)))
                << testing::PrintToString(pos) << " block " << x << " " << y;
        }
    }
}

constexpr std::array<int, 5> kLevels = {0, 1, 2, 6, world::kMaxLevel};

TEST(BuilderLevels, PositionsAreThoseOfTheMiddleOfColumns) {
    for (const int level : kLevels) {
        const auto write = [](GeneratorBuilder& g) {
            g.pass3D("only", [](Pass& p) {
                p.setBlock(Block((p.x() ^ (p.x() >> 16)) * 3 + (p.y() ^ (p.y() >> 16)) * 5 + p.step()));
            });
        };
        const auto mixed = [](std::int64_t v) {
            const auto low = static_cast<std::int32_t>(v);
            return std::int64_t{low ^ (low >> 16)};
        };
        ASSERT_NO_FATAL_FAILURE(expectColumns(level, write, [&](std::int64_t x, std::int64_t y) {
            return mixed(x) * 3 + mixed(y) * 5 + (1 << level);
        }));
    }
}

TEST(BuilderLevels, AStepIsAConstantForCppAndForExpressions) {
    for (const int level : kLevels) {
        GeneratorBuilder builder("test", testBlocks(), level);
        EXPECT_EQ(builder.step(), 1 << level);
        builder.pass3D("only", [&](Pass& p) { EXPECT_EQ(p.step(), 1 << level); });
    }
}

TEST(BuilderLevels, ALevelThatIsNoneIsAMistake) {
    for (const int level : {-1, world::kMaxLevel + 1}) {
        GeneratorBuilder builder("test", testBlocks(), level);
        builder.pass3D("only", [](Pass&) {});
        const auto graph = builder.finish();
        ASSERT_FALSE(graph);
        EXPECT_THAT(graph.error().message, HasSubstr("is not in 0…15"));
    }
}

// A field that knows its column, read from others: the nearest column to each offset.
TEST(BuilderLevels, ReadsGoToTheNearestColumn) {
    for (const int level : {0, 1, 2, 3, 5}) {
        for (const int offset : {-16, -5, -3, -2, -1, 0, 1, 2, 3, 4, 7, 16}) {
            const auto write = [&](GeneratorBuilder& g) {
                const auto f = g.field<Int>("f"), moved = g.field<Int>("moved");
                g.pass2D("f", [&](Pass& p) { p.set(f, p.x() * 7 + p.y()); });
                g.pass2D("moved", [&](Pass& p) {
                    const Int computed = select(p.x() == p.x() + 1, Int(0), Int(offset));
                    p.set(moved, p.readAt(f, {offset, 0}) * 3 + p.readAt(f, {0, computed}));
                });
                g.pass3D("only", [&](Pass& p) { p.setBlock(Block(p.read(moved))); });
            };
            const std::int64_t step = 1 << level;
            const auto blocks = static_cast<std::int64_t>(
                                    std::floor((static_cast<double>(offset) + static_cast<double>(step / 2)) /
                                               static_cast<double>(step))) *
                                step;
            const auto f = [](std::int64_t x, std::int64_t y) { return x * 7 + y; };
            ASSERT_NO_FATAL_FAILURE(expectColumns(
                level, write,
                [&](std::int64_t x, std::int64_t y) { return f(x + blocks, y) * 3 + f(x, y + blocks); }))
                << "level " << level << " offset " << offset;
        }
    }
}

TEST(BuilderLevels, BlocksAreReadFromTheNearestColumn) {
    const auto write = [](GeneratorBuilder& g) {
        g.pass3D("first", [](Pass& p) { p.setBlock(Block(p.x() + p.y() * 5)); });
        g.pass3D("last", [](Pass& p) { p.setBlock(p.blockAt({-5, 3}, p.z())); });
    };
    // (−5 + 2) >> 2 = −1 and (3 + 2) >> 2 = 1 columns.
    expectColumns(2, write, [](std::int64_t x, std::int64_t y) { return (x - 4) + (y + 4) * 5; });
}

// A plane has the same slope at every level, and a value between columns is where it should be.
TEST(BuilderLevels, SlopesAndBlendsCountBlocks) {
    for (const int level : {0, 1, 2, 4, 8}) {
        const auto write = [](GeneratorBuilder& g) {
            const auto f = g.field<Float>("f");
            g.pass2D("f", [&](Pass& p) {
                p.set(f, Float(p.x() & 0xFFFF) * 0.5f - Float(p.y() & 0xFFFF) * 0.25f);
            });
            g.pass3D("only", [&](Pass& p) {
                const Vec2 slope = p.slope(f);
                const Float between = p.readBetween(f, {3.5f, -6.5f}) - p.read(f);
                p.setBlock(
                    Block(Int(slope.x * 64.0f) * 256 + Int(slope.y * -64.0f) + Int(between * 1024.0f)));
            });
        };
        const Generator generator(buildLevel(level, write), kTestSeed);
        // In the middle of the tile, where the neighbors' positions do not wrap at 2^16.
        const BlockId number = numbersOf(generator, {1, 1, static_cast<std::uint8_t>(level)})[16 * 8 + 8];
        EXPECT_EQ(number, static_cast<BlockId>(32 * 256 + 16 + 3 * 1024 + 384)) << level;
    }
}

// A plane that falls toward +x and +y: of the columns beside, one of these is the lowest.
TEST(BuilderLevels, LowestBesideLooksAtTheNextColumns) {
    for (const int level : {0, 1, 3, 8}) {
        const auto write = [](GeneratorBuilder& g) {
            const auto f = g.field<Float>("f");
            g.pass2D("f", [&](Pass& p) {
                p.set(f, Float(p.x() & 0xFFFF) * -2.0f - Float(p.y() & 0xFFFF) * 3.0f);
            });
            g.pass3D("only", [&](Pass& p) { p.setBlock(Block(Int(p.read(f) - p.lowestBeside(f)))); });
        };
        const Generator generator(buildLevel(level, write), kTestSeed);
        const BlockId number = numbersOf(generator, {1, 1, static_cast<std::uint8_t>(level)})[16 * 8 + 8];
        EXPECT_EQ(number, static_cast<BlockId>(3 << level)) << level;
    }
}

// Octaves of 3, 6 and 12 blocks at 4 blocks a column: none, half and all of the weight.
TEST(BuilderLevels, ShortOctavesFade) {
    const auto write = [](GeneratorBuilder& g) {
        g.pass3D("only", [](Pass& p) {
            p.setBlock(Block(Int(p.perlin2D("n", 3, {9.0f, 1.0f, 1.0f}) * 1000.0f) +
                             Int(p.perlin3D("short", 4, {1.0f}))));
        });
    };
    const GeneratorGraph graph = buildLevel(2, write);
    ASSERT_EQ(graph.noises.size(), 1u) << "a noise that has faded is not computed";
    EXPECT_EQ(graph.noises[0].weights, (std::vector<float>{0.0f, 0.5f, 1.0f}));
    const std::uint32_t seed = makeSeeds(graph, kTestSeed).noises[0];
    expectColumns(2, write, [&](std::int64_t x, std::int64_t y) {
        return static_cast<std::int32_t>(reference::perlin2D(graph.noises[0], seed, x, y) * 1000.0f);
    });
}

// Noise of expressions and gradients fade alike: where nothing is left they are zero everywhere.
TEST(BuilderLevels, NoiseOfExpressionsFades) {
    const auto write = [](GeneratorBuilder& g) {
        g.pass3D("only", [](Pass& p) {
            const Float simplex = p.simplex2D("s", 8, {1.0f}) + p.simplex3D("t", 4, {1.0f, 1.0f});
            const Vec2 flat = p.perlin2DGradient("u", 8, {1.0f});
            const Vec3 solid = p.perlin3DGradient("v", 8, {1.0f});
            p.setBlock(Block(Int((simplex + flat.x + solid.z) * 1000.0f) + 5));
        });
    };
    expectColumns(3, write, [](std::int64_t, std::int64_t) { return 5; });
}

TEST(BuilderLevels, SmallVoronoiCellsHaveTheirMeans) {
    const auto write = [](GeneratorBuilder& g) {
        g.pass3D("only", [](Pass& p) {
            const Voronoi2D flat = p.voronoi2D("flat", 7, 1);
            const Voronoi3D solid = p.voronoi3D("solid", 7, 2, 4);
            p.setBlock(Block(Int((flat.distance + solid.distance) * 1000.0f) + flat.offset.x +
                             solid.offset.z + Int(flat.ratio * 100.0f)));
        });
    };
    EXPECT_TRUE(buildLevel(3, write).noises.empty());
    EXPECT_EQ(buildLevel(2, write).noises.size(), 2u);
    const float distance = voronoiMean2D(1).distance * 7.0f + voronoiMean3D(2, 4).distance * 7.0f;
    expectColumns(3, write, [&](std::int64_t, std::int64_t) {
        return static_cast<int>(distance * 1000.0f) + static_cast<int>(voronoiMean2D(1).ratio * 100.0f);
    });
}

// The means of the table against cells so large that blocks do not matter.
TEST(VoronoiMean, IsThatOfTheNoise) {
    constexpr std::int64_t kSize = 1000;
    for (const int points : {1, 2, 3, 4}) {
        double distance = 0, ratio = 0;
        constexpr int kSamples = 4000;
        for (int k = 0; k < kSamples; ++k) {
            const NoiseCall call = {NoiseKind::Voronoi2D, "n", kSize, {}, points};
            const auto sample = reference::voronoi2D(call, 99, k * 2737, k * 5791, 2);
            distance += static_cast<double>(sample.distance) / static_cast<double>(kSize) / kSamples;
            ratio += static_cast<double>(sample.ratio) / kSamples;
        }
        EXPECT_NEAR(distance, static_cast<double>(voronoiMean2D(points).distance), 0.015);
        EXPECT_NEAR(ratio, static_cast<double>(voronoiMean2D(points).ratio), 0.02);
    }
}

}  // namespace
}  // namespace terrane::gen
