#include "terrane/gen/compile/top_down_passes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "terrane/gen/generators/catalogue.h"
#include "tests/gen/gen_fixture.h"
#include "tests/support/default_heights.h"
#include "tests/support/depth.h"

namespace terrane::gen {
namespace {

using Layer = std::span<const BlockId, kTileLanes>;

// Each column is requested down to a random height, some down to the bottom.
std::vector<int> randomDepths(world::Heights heights, std::mt19937& random) {
    std::vector<int> depths(kTileLanes);
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    const int low = heights.bottom + below(heights.layers() - 6);
    for (int& depth : depths) depth = below(20) == 0 ? heights.bottom : low + below(6);
    return depths;
}

// The chunk's blocks from generateTopDown(): each column down to its depth, others unknown.
std::vector<std::optional<BlockId>> seenFromAbove(const Generator& generator, ChunkPos pos,
                                                  const std::vector<int>& depths) {
    const world::Heights heights = generator.heights();
    std::vector<std::optional<BlockId>> seen(static_cast<std::size_t>(heights.layers()) * kTileLanes);
    const auto note = [&](int z, auto blockOf) {
        for (std::size_t k = 0; k < kTileLanes; ++k)
            if (z >= depths[k])
                seen[static_cast<std::size_t>(z - heights.bottom) * kTileLanes + k] = blockOf(k);
    };
    int above = heights.top;
    BlockId blockAbove = 0;  // of the layers that are left out
    generator.generateTopDown(pos, [&](int z, Layer layer, RequestedColumns& requested) {
        EXPECT_LT(z, above);
        while (--above > z) note(above, [&](std::size_t) { return blockAbove; });
        note(z, [&](std::size_t k) { return layer[k]; });
        blockAbove = layer[0];
        for (std::size_t k = 0; k < kTileLanes; ++k)
            if (z <= depths[k]) requested.drop(k);
    });
    while (--above >= heights.bottom) note(above, [&](std::size_t) { return blockAbove; });
    return seen;
}

// From above first: results of a whole chunk must not help.
void expectLayersOf(const Generator& generator, ChunkPos pos, const std::vector<int>& depths) {
    const auto seen = seenFromAbove(generator, pos, depths);
    const std::vector<BlockId> whole = blocksOf(generator.generate(pos));
    for (std::size_t i = 0; i < whole.size(); ++i)
        ASSERT_EQ(seen[i].value_or(whole[i]), whole[i])
            << "column " << i % kTileLanes << ", layer " << i / kTileLanes << " from the bottom";
}

// generateDown() makes the sections down to a random one, and nothing below.
void expectSectionsOf(const Generator& generator, ChunkPos pos, std::mt19937& random) {
    const world::Heights heights = generator.heights();
    const int lowest =
        heights.firstSection() + static_cast<int>(random() % static_cast<unsigned>(heights.sections()));
    const world::Chunk deep = generator.generateDown(pos, [&](const world::Chunk& chunk, int section) {
        EXPECT_EQ(chunk.heights(), heights);
        return section > lowest;
    });
    world::Chunk expected = generator.generate(pos);
    expected.unmakeBelow(lowest);
    EXPECT_EQ(deep, expected) << "down to section " << lowest;
}

void expectSameDown(const Generator& generator, int chunks) {
    std::mt19937 random(7);
    for (int k = 0; k < chunks && !testing::Test::HasFatalFailure(); ++k) {
        const auto at = [&] { return static_cast<std::int32_t>(random() % 20000) - 10000; };
        const ChunkPos pos = {at() >> generator.level(), at() >> generator.level(),
                              static_cast<std::uint8_t>(generator.level())};
        SCOPED_TRACE(testing::PrintToString(pos));
        expectSectionsOf(generator, pos, random);
        expectLayersOf(generator, pos, randomDepths(generator.heights(), random));
    }
}

TEST(GenerateDown, LayersAreThoseOfTheWholeChunk) {
    const int kChunks = atDepth(2, 20);
    for (const std::string& name : namesOf(builtInGenerators()))
        for (int level = 0; level <= world::kMaxLevel; ++level) {
            SCOPED_TRACE(name + ", level " + std::to_string(level));
            auto graph = makeGenerator(name, contentBlocks(), level);
            ASSERT_TRUE(graph.has_value()) << graph.error().message;
            const bool isSlow =
                name == "hills3d" || name == "voronoi" || graph->heights.layers() > world::kChunkHeight;
            expectSameDown(Generator(std::move(*graph), 3), isSlow ? (kChunks + 4) / 5 : kChunks);
            if (HasFatalFailure()) return;
        }
}

// Hollow ground with some noise in space.
void hollowGround(Pass& p) {
    const Bool isGround = Float(p.z()) < p.perlin2D("hills", 16, {10.0f, 30.0f}) + 100.0f;
    p.setBlock(select(isGround && p.perlin3D("holes", 12, {1.0f}) < 0.25f, p.block("stone"), p.block("air")));
}

// Changes a block by the blocks `below` and `above` it.
void nearLayers(Pass& p, int below, int above) {
    const Bool isOpen = p.blockInColumn(p.z() + above) == p.block("air");
    const Bool isHigh = p.blockInColumn(p.z() - below) == p.block("air");
    const Block here = p.blockHere();
    const Bool changes = p.perlin3D("changes " + std::to_string(below), 8, {1.0f}) > -0.1f;
    p.if_(changes, [&] {
        p.setBlock(
            select(isOpen && isHigh, p.block("water"), select(isOpen || isHigh, p.block("dirt"), here)));
    });
}

void expectSameDown(const Write& write) {
    expectSameDown(Generator(build(write), kTestSeed), 10);
    for (const world::Heights heights : kSomeHeights) {
        SCOPED_TRACE(world::describe(heights));
        expectSameDown(Generator(build(write, {0, heights}), kTestSeed), 1);
    }
}

TEST(GenerateDown, PassesReadLayersBelowAndAbove) {
    expectSameDown([](GeneratorBuilder& g) {
        g.pass3D("ground", hollowGround);
        g.pass3D("first", [](Pass& p) { nearLayers(p, 5, 2); });
        g.pass3D("second", [](Pass& p) { nearLayers(p, 1, 9); });
        g.pass3D("third", [](Pass& p) { nearLayers(p, 40, 0); });
    });
}

TEST(GenerateDown, APassMayReadAnyLayer) {
    expectSameDown([](GeneratorBuilder& g) {
        g.pass3D("ground", hollowGround);
        g.pass3D("floor", [](Pass& p) {
            const Bool isHollow =
                p.blockInColumn(Int(p.perlin2D("where", 8, {40.0f})) + 60) == p.block("air");
            p.setBlock(select(isHollow && p.z() > 150, p.block("water"), p.blockHere()));
        });
        g.pass3D("mirror", [](Pass& p) { p.setBlock(p.blockInColumn(255 - p.z())); });
    });
}

TEST(GenerateDown, APassMayReadNeighborsAndFieldsOf3DPasses) {
    expectSameDown([](GeneratorBuilder& g) {
        const auto low = g.field<Int>("low");
        g.pass3D("ground", hollowGround);
        g.pass3D("spread", [&](Pass& p) {
            p.setBlock(p.blockAt({3, -2}, p.z() + 1));
            p.setAt(low, Int(20), Int(p.blockHere()));
        });
        g.pass3D("last", [&](Pass& p) {
            p.setBlock(
                select(p.read(low) == Int(p.block("stone")), p.blockInColumn(p.z() - 1), p.blockHere()));
        });
    });
}

TEST(GenerateDown, NothingIsMadeOnceNoColumnIsWanted) {
    const Generator generator(build([](GeneratorBuilder& g) { g.pass3D("ground", hollowGround); }),
                              kTestSeed);
    int layers = 0;
    generator.generateTopDown({0, 0}, [&](int, Layer, RequestedColumns& requested) {
        if (++layers < 3) return;
        for (std::size_t k = 0; k < kTileLanes; ++k) requested.drop(k);
    });
    EXPECT_EQ(layers, 3);
}

TEST(GenerateDown, EndsAtTheBottomOfTheWorld) {
    const Generator generator(build([](GeneratorBuilder& g) { g.pass3D("ground", hollowGround); }),
                              kTestSeed);
    EXPECT_EQ(generator.generateDown({0, 0}, [](const world::Chunk&, int) { return true; }),
              generator.generate({0, 0}));
}

TEST(GenerateDown, RefusesOtherLevels) {
    const Generator generator(build([](GeneratorBuilder& g) { g.pass3D("ground", hollowGround); }),
                              kTestSeed);
    EXPECT_THROW(generator.generateTopDown({0, 0, 1}, [](int, Layer, RequestedColumns&) {}),
                 std::invalid_argument);
}

std::optional<int> readBelow(const std::function<void(Pass&)>& pass) {
    const GeneratorGraph graph = build([&](GeneratorBuilder& g) {
        g.pass3D("ground", hollowGround);
        g.pass3D("reads", pass);
    });
    return layersReadBelow(graph.passes.back());
}

TEST(LayersReadBelow, CountsFromZ) {
    EXPECT_EQ(readBelow([](Pass& p) { p.setBlock(p.blockHere()); }), 0);
    EXPECT_EQ(readBelow([](Pass& p) { nearLayers(p, 7, 2); }), 7);
    EXPECT_EQ(readBelow([](Pass& p) { p.setBlock(p.blockInColumn(p.z() + 3)); }), 0);
    EXPECT_EQ(readBelow([](Pass& p) { p.setBlock(p.blockInColumn(Int(-3) + p.z())); }), 3);
}

// Fields of heights in the world and far from it, read with and without a distance.
TEST(GenerateDown, PassesReadAtHeightsOfFields) {
    expectSameDown([](GeneratorBuilder& g) {
        const auto height = g.field<Int>("height"), far = g.field<Int>("far");
        g.pass2D("heights", [&](Pass& p) {
            p.set(height, Int(p.perlin2D("hills", 16, {10.0f, 30.0f})) + 60);
            p.set(far, select(p.x() > 0, Int(INT32_MIN), Int(INT32_MAX)));
        });
        g.pass3D("ground", hollowGround);
        g.pass3D("marks", [&](Pass& p) {
            const Bool isHollow = p.blockInColumn(p.read(height) - 9) == p.block("air");
            const Bool isOpen = p.blockInColumn(p.read(height)) == p.block("air");
            const Bool isFar = p.blockInColumn(p.read(far) + 5) == p.block("air");
            p.if_(p.z() > p.read(height),
                  [&] { p.setBlock(select(isHollow && p.z() < 120, p.block("dirt"), p.blockHere())); });
            p.if_(p.z() < 20 && isOpen,
                  [&] { p.setBlock(select(isFar, p.block("water"), p.blockInColumn(p.z() - 2))); });
        });
        g.pass3D("reads", [](Pass& p) { nearLayers(p, 3, 1); });
    });
}

TEST(LayersReadBelow, LeavesOutHeightsOfFields) {
    const GeneratorGraph graph = build([](GeneratorBuilder& g) {
        const auto height = g.field<Int>("height");
        g.pass2D("heights", [&](Pass& p) { p.set(height, Int(p.x())); });
        g.pass3D("ground", hollowGround);
        g.pass3D("reads", [&](Pass& p) {
            p.setBlock(select(p.blockInColumn(p.read(height) - 7) == p.block("air"),
                              p.blockInColumn(p.read(height)), p.blockInColumn(p.z() - 2)));
        });
    });
    const PassGraph& pass = graph.passes.back();
    EXPECT_EQ(layersReadBelow(pass), 2);
    EXPECT_EQ(firstTopDownPass(graph), 1);
    ColumnValues heights;
    heights.fill(bitsOf(100));
    heights[3] = bitsOf(40);
    PassInputs inputs;
    inputs.fields.resize(1);
    inputs.fields[0][4] = &heights;
    EXPECT_EQ(lowestFieldRead(pass, inputs, {}), 33);
    heights[3] = bitsOf(-900);
    EXPECT_EQ(lowestFieldRead(pass, inputs, {}), 0);
    EXPECT_EQ(lowestFieldRead(graph.passes[1], inputs, {}), 256);
}

// The ground under the land is not made: only as deep as the plants look.
TEST(GenerateDown, TheOverworldMakesNoMoreThanIsAskedFor) {
    const auto graph = makeGenerator("overworld", contentBlocks(), 0);
    ASSERT_TRUE(graph.has_value());
    ASSERT_TRUE(graph->passes[graph->passes.size() - 2].is3D);
    EXPECT_EQ(firstTopDownPass(*graph), static_cast<int>(graph->passes.size()) - 2);
}

TEST(LayersReadBelow, IsUnknownBeyondAWorld) {
    const auto above = [](std::int32_t blocks) {
        return readBelow([blocks](Pass& p) { p.setBlock(p.blockInColumn(p.z() + blocks)); });
    };
    EXPECT_EQ(above(world::kMostLayers), 0);
    EXPECT_EQ(above(-world::kMostLayers), world::kMostLayers);
    for (const std::int32_t far : {world::kMostLayers + 1, -world::kMostLayers - 1, INT32_MAX, INT32_MIN}) {
        EXPECT_EQ(above(far), std::nullopt) << far;
        EXPECT_EQ(readBelow([far](Pass& p) { p.setBlock(p.blockInColumn(p.z() - far)); }), std::nullopt);
        EXPECT_EQ(readBelow([far](Pass& p) { p.setBlock(p.blockInColumn(Int(far) + p.z())); }), std::nullopt);
    }
}

TEST(CanRunDown, NeedsAPassThatMakesBlocks) {
    GeneratorGraph graph = build([](GeneratorBuilder& g) {
        const auto height = g.field<Int>("height");
        g.pass2D("heights", [&](Pass& p) { p.set(height, Int(p.x())); });
        g.pass3D("ground", [&](Pass& p) {
            p.setBlock(select(p.z() < p.read(height), p.block("stone"), p.block("air")));
        });
    });
    EXPECT_TRUE(canRunTopDown(graph));
    EXPECT_EQ(firstTopDownPass(graph), 1);
    EXPECT_FALSE(canRunTopDown(GeneratorGraph()));
    graph.passes.pop_back();
    EXPECT_FALSE(canRunTopDown(graph));
    EXPECT_THROW(firstTopDownPass(graph), std::invalid_argument);
    const Generator columns(std::move(graph), kTestSeed);
    EXPECT_THROW(columns.generateTopDown({0, 0}, [](int, Layer, RequestedColumns&) {}),
                 std::invalid_argument);
}

TEST(LayersReadBelow, IsUnknownWhereAHeightIsNoConstantFromZ) {
    EXPECT_EQ(readBelow([](Pass& p) { p.setBlock(p.blockInColumn(40)); }), std::nullopt);
    EXPECT_EQ(readBelow([](Pass& p) { p.setBlock(p.blockInColumn(p.x())); }), std::nullopt);
    EXPECT_EQ(readBelow([](Pass& p) { p.setBlock(p.blockInColumn(3 - p.z())); }), std::nullopt);
    EXPECT_EQ(readBelow([](Pass& p) { p.setBlock(p.blockAt({1, 0}, p.z())); }), std::nullopt);
}

TEST(RequestedColumns, AreDroppedOneByOne) {
    RequestedColumns requested;
    EXPECT_EQ(requested.rows(), kAllRows);
    for (std::size_t k = 32; k < 47; ++k) requested.drop(k);
    requested.drop(32);
    EXPECT_FALSE(requested.has(32));
    EXPECT_TRUE(requested.has(47));
    EXPECT_EQ(requested.rows(), kAllRows);
    requested.drop(47);
    EXPECT_EQ(requested.rows(), kAllRows & ~(1 << 2));
    for (std::size_t k = 0; k < kTileLanes; ++k) requested.drop(k);
    EXPECT_EQ(requested.rows(), 0);
    EXPECT_FALSE(requested.has(255));
}

}  // namespace
}  // namespace terrane::gen
