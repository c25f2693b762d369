// Pass::stamp, through the generator, against a search of every shape around.
#include "terrane/gen/noise/stamp_tile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <random>
#include <set>
#include <string>

#include "terrane/gen/cpu/slab_ranges.h"
#include "tests/gen/gen_fixture.h"
#include "tests/gen/pass_runner.h"
#include "tests/gen/stamp_fixture.h"
#include "tests/support/default_heights.h"

namespace terrane::gen {
namespace {

using testing::HasSubstr;

constexpr StampLand kDense = {60}, kSparse = {8, 1000}, kNowhere = {0}, kEverywhere = {4096};

Generator stampGenerator(int level, const StampLand& first, const StampLand& second) {
    GeneratorBuilder builder("stamps", testBlocks(), level);
    writeStamps(builder, first, second);
    auto graph = builder.finish();
    EXPECT_TRUE(graph.has_value()) << (graph ? "" : graph.error().message);
    return Generator(std::move(*graph), kTestSeed);
}

// Random voxels of a chunk, most of them where most shapes are.
void expectSlowStamps(ChunkPos pos, const StampLand& first, const StampLand& second, int voxels) {
    const std::vector<BlockId> blocks = blocksOf(stampGenerator(pos.level, first, second).generate(pos));
    const SlowStamps slow(testBlocks(), pos, first), slow2(testBlocks(), pos, second);
    std::mt19937 random(5);
    for (int k = 0; k < voxels; ++k) {
        const int x = static_cast<int>(random() % 16), y = static_cast<int>(random() % 16);
        const int z = static_cast<int>(k % 4 == 0 ? random() % 256 : 50 + random() % 60);
        const BlockId one = slow.block(x, y, z), want = one == world::kAir ? slow2.block(x, y, z) : one;
        ASSERT_EQ(blocks[world::blockIndex(x, y, z)], want) << x << " " << y << " " << z;
    }
}

TEST(Stamps, EqualALookAtEveryShapeAround) {
    for (int level = 0; level <= 3; ++level) {
        for (const ChunkPos pos : placesOf(level)) {
            SCOPED_TRACE(testing::PrintToString(pos));
            expectSlowStamps(pos, kDense, kSparse, kRandomCases / 2);
            if (HasFatalFailure()) return;
        }
    }
}

TEST(Stamps, AreTheSameOnEveryInstructionSet) {
    onEachTarget([] { expectSlowStamps({-7, 4}, kDense, kSparse, kRandomCases / 2); });
}

TEST(Stamps, StandInEveryColumn) {
    expectSlowStamps({3, -2}, kEverywhere, kNowhere, kRandomCases / 10);
}

TEST(Stamps, NothingStandsWhereNoShapeIs) {
    for (const BlockId id : blocksOf(stampGenerator(0, kNowhere, kNowhere).generate({0, 0})))
        ASSERT_EQ(id, world::kAir);
}

TEST(Stamps, ReachIntoTheWorldFromBelowAndAbove) {
    expectBlocks(writeStampsAtTheEnds, [](std::int32_t x, std::int32_t, std::int32_t z) {
        return z == ((x & 1) == 0 ? 0 : 255) ? 1 : 0;
    });
}

// A shape with its foot at (x, y) alone, in layers that hold nothing else.
GeneratorGraph oneFoot(const VoxelShape& shape, int x, int y, int z) {
    return build([&](GeneratorBuilder& g) {
        const auto number = g.field<Int>("number"), base = g.field<Int>("base");
        g.shape(randomShape(9, 2, 5));
        const int wanted = g.shape(shape);
        EXPECT_EQ(wanted, 1);
        g.pass2D("feet", [&](Pass& p) {
            p.set(number, select(p.x() == x && p.y() == y, Int(wanted), Int(-1)));
            p.set(base, Int(z));
        });
        g.pass3D("stamps", [&](Pass& p) { p.setBlock(p.stamp(number, base)); });
    });
}

TEST(Stamps, AShapeOverTheCornerOfFourChunksIsWhole) {
    const VoxelShape shape = randomShape(7, 16, 2000);
    for (const IVec2& foot : {IVec2{15, 15}, IVec2{16, 0}, IVec2{-1, 8}}) {
        const int fx = asInt(foot.x.bits), fy = asInt(foot.y.bits);
        const Generator generator(oneFoot(shape, fx, fy, 100), kTestSeed);
        std::vector<std::vector<BlockId>> chunks;
        for (int n = 0; n < 25; ++n) chunks.push_back(blocksOf(generator.generate({n % 5 - 2, n / 5 - 2})));
        for (const ShapeVoxel& v : shape.voxels) {
            const int x = fx + v.x + 32, y = fy + v.y + 32;
            BlockId& block = chunks[static_cast<std::size_t>(y / 16 * 5 + x / 16)]
                                   [world::blockIndex(x % 16, y % 16, 100 + v.z)];
            ASSERT_EQ(block, testBlocks().find(shape.blocks[v.block].name)->id);
            block = world::kAir;
        }
        for (const auto& chunk : chunks)
            for (const BlockId block : chunk) ASSERT_EQ(block, world::kAir);
    }
}

// Ranges find air in all layers but the painted ones, before any is computed.
void expectCertain(const GeneratorGraph& graph, const StampTile& tile, const std::set<int>& painted) {
    const Program program = compile(graph.passes.back(), graph.noises);
    std::vector<Bits> arena(std::size_t{program.arenaRows} * kRowLanes);
    const SlabPlan plan(graph.passes.back(), program, graph.noises);
    SlabRanges ranges;
    ranges.begin(plan, arena.data(), nullptr, std::span(&tile, 1));
    const auto blockOf = [&](int z, int count) {
        ranges.analyze(z, count);
        return ranges.block();
    };
    for (int z = 0; z < world::kChunkHeight; ++z) {
        EXPECT_EQ(blockOf(z, 1).has_value(), !painted.contains(z)) << z;
    }
    EXPECT_EQ(blockOf(32, 16), world::kAir);
    EXPECT_EQ(blockOf(16, 16), std::nullopt);
}

TEST(Stamps, LayersThatNoShapeReachesAreCertain) {
    PassRunner runner(oneFoot({"post", {{"stone", 1}}, {{0, 0, 0, 0}, {0, 0, 3, 0}}}, 5, 5, 20));
    runner.around.resize(2);
    for (std::size_t n = 0; n < 9; ++n) {
        runner.around[0][n].fill(bitsOf(-1));
        runner.around[1][n].fill(bitsOf(20));
    }
    runner.around[0][4][5 + 16 * 5] = bitsOf(1);
    const auto blocks = runner.run3D(1);
    for (int z = 0; z < 256; ++z) {
        const bool isPost = z == 20 || z == 23;
        ASSERT_EQ((*blocks)[world::blockIndex(5, 5, z)], isPost ? 1 : 0) << z;
    }
    StampTile tile;
    std::vector<Bits> numbers(48 * 48, bitsOf(-1)), bases(48 * 48, bitsOf(20));
    numbers[21 * 48 + 21] = bitsOf(1);
    for (int round = 0; round < 2; ++round) {  // nothing stays of what was painted before
        tile.paint(*runner.graph.shapes, {}, numbers, bases);
        const auto isPainted = [&](int low, int high) {
            return tile.blocks().range(low, high)->blocks.high != 0;
        };
        for (int z = 0; z < 256; ++z) EXPECT_EQ(isPainted(z, z), z == 20 + round || z == 23 + round) << z;
        expectCertain(runner.graph, tile, {20 + round, 23 + round});
        EXPECT_TRUE(isPainted(0, 255));
        EXPECT_FALSE(isPainted(0, 19 + round));
        EXPECT_FALSE(isPainted(24 + round, 255));
        bases.assign(bases.size(), bitsOf(21));
    }
}

std::string errorOf(const Write& write) {
    const auto graph = tryToBuild(write);
    EXPECT_FALSE(graph.has_value());
    return graph ? "" : graph.error().message;
}

std::string shapeError(const VoxelShape& shape) {
    return errorOf([&](GeneratorBuilder& g) {
        g.shape(shape);
        g.pass3D("fine", [](Pass&) {});
    });
}

TEST(Stamps, MistakesInShapesAreNamed) {
    const auto prefix = [](const std::string& text) { return "generator \"test\": shape \"odd\": " + text; };
    const std::vector<ShapeBlock> stone = {{"stone", 1}};
    EXPECT_EQ(shapeError({"odd", stone, {}}), prefix("has no voxels"));
    EXPECT_EQ(shapeError({"odd", {{"marzipan", 0}}, {{0, 0, 0, 0}}}), prefix("unknown block \"marzipan\""));
    EXPECT_EQ(shapeError({"odd", {{"stone", 4}}, {{0, 0, 0, 0}}}), prefix("rank 4 is not in 0…3"));
    EXPECT_EQ(shapeError({"odd", stone, {{17, 0, 2, 0}}}),
              prefix("voxel (17, 0, 2) is beyond 16 blocks of the foot"));
    EXPECT_EQ(shapeError({"odd", stone, {{0, -17, 2, 0}}}),
              prefix("voxel (0, -17, 2) is beyond 16 blocks of the foot"));
    EXPECT_EQ(shapeError({"odd", stone, {{0, 0, 49, 0}}}), prefix("voxel (0, 0, 49): z is not in -8…48"));
    EXPECT_EQ(shapeError({"odd", stone, {{0, 0, -9, 0}}}), prefix("voxel (0, 0, -9): z is not in -8…48"));
    EXPECT_EQ(shapeError({"odd", stone, {{0, 0, 0, 1}}}), prefix("voxel (0, 0, 0) has block 1 of 1"));
    EXPECT_EQ(shapeError({"odd", stone, {{1, 0, 0, 0}, {1, 0, 0, 0}}}),
              prefix("voxel (1, 0, 0) is there twice"));
}

TEST(Stamps, TooManyShapesAreRefused) {
    const auto write = [](int count, std::int8_t size) {
        return [=](GeneratorBuilder& g) {
            const auto number = g.field<Int>("number");
            VoxelShape shape = {"post", {{"stone", 1}}, {{0, 0, 0, 0}}};
            if (size > 0) {
                const auto low = static_cast<std::int8_t>(-size);
                shape.voxels = {{low, low, -8, 0}, {0, 0, 0, 0}, {size, size, 48, 0}};
            }
            for (int k = 0; k < count; ++k) g.shape(shape);
            g.pass2D("feet", [&](Pass& p) { p.set(number, Int(0)); });
            g.pass3D("stamps", [&](Pass& p) { p.setBlock(p.stamp(number, number)); });
        };
    };
    EXPECT_TRUE(tryToBuild(write(1024, 0)).has_value());
    EXPECT_EQ(errorOf(write(1026, 0)), "generator \"test\": more than 1024 shapes");
    EXPECT_EQ(errorOf(write(400, 16)),
              "generator \"test\": its shapes take 24829200 bytes, at most 15728640 are possible");
}

TEST(Stamps, ShapesHaveAtMostThisManyBlocks) {
    std::string toml;
    for (int k = 0; k < 300; ++k)
        toml += fmt::format("[[block]]\nname = \"b{}\"\nshape = \"cube\"\ntexture = \"stone\"\n", k);
    const auto blocks = world::BlockRegistry::parse(toml, "test").value();
    const auto errorOf = [&](int count) {
        GeneratorBuilder g("test", blocks);
        const auto number = g.field<Int>("number");
        VoxelShape shape = {"post", {}, {}};
        for (int k = 0; k < count; ++k) {
            shape.blocks.push_back({fmt::format("b{}", k), 1});
            shape.voxels.push_back({static_cast<std::int8_t>(k % 16 - 8),
                                    static_cast<std::int8_t>(k / 16 - 8), 0, static_cast<std::uint8_t>(k)});
        }
        g.shape(shape);
        g.pass2D("feet", [&](Pass& p) { p.set(number, Int(0)); });
        g.pass3D("stamps", [&](Pass& p) { p.setBlock(p.stamp(number, number)); });
        const auto graph = g.finish();
        return graph ? std::string() : graph.error().message;
    };
    EXPECT_EQ(errorOf(255), "");
    EXPECT_EQ(errorOf(256), "generator \"test\": its shapes have 256 blocks, at most 255 are possible");
}

TEST(Stamps, MistakesInPassesAreNamed) {
    EXPECT_THAT(errorOf([](GeneratorBuilder& g) {
                    const auto number = g.field<Int>("number");
                    g.pass2D("flat", [&](Pass& p) {
                        p.stamp(number, number);
                        p.set(number, Int(0));
                    });
                    g.pass3D("fine", [](Pass&) {});
                }),
                HasSubstr("pass \"flat\": stamp: only in 3D passes"));
    EXPECT_THAT(errorOf([](GeneratorBuilder& g) {
                    const auto number = g.field<Int>("number");
                    g.pass3D("stamps", [&](Pass& p) { p.setBlock(p.stamp(number, number)); });
                }),
                HasSubstr("field \"number\" is read, but no earlier pass writes it"));
    EXPECT_THAT(errorOf([](GeneratorBuilder& g) {
                    const auto a = g.field<Int>("a"), b = g.field<Int>("b");
                    g.pass2D("feet", [&](Pass& p) {
                        p.set(a, Int(0));
                        p.set(b, Int(0));
                    });
                    g.pass3D("stamps", [&](Pass& p) {
                        for (const auto& [s, z] : {std::pair(a, b), std::pair(b, a), std::pair(a, a)})
                            p.setBlock(p.stamp(s, z));
                    });
                }),
                HasSubstr("pass \"stamps\": stamps from more than 2 pairs of fields"));
}

TEST(Stamps, TablesAreLeftOutWhereNothingStamps) {
    const GeneratorGraph graph = build([](GeneratorBuilder& g) {
        EXPECT_EQ(g.shape(randomShape(1, 4, 20)), 0);
        EXPECT_EQ(g.shape(randomShape(2, 4, 20)), 1);
        g.pass3D("fine", [](Pass&) {});
    });
    EXPECT_EQ(graph.shapes, nullptr);
    EXPECT_EQ(sharedPasses(graph), 0);
}

}  // namespace
}  // namespace terrane::gen
