// Generators of worlds that are not 0…255 high.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "terrane/base/digest.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/level_generators.h"
#include "tests/gen/gen_fixture.h"
#include "tests/gen/stamp_fixture.h"

namespace terrane::gen {
namespace {

using testing::HasSubstr;
using world::Heights;

constexpr Heights kTallest = {world::kLowestBottom, world::kHighestTop};

// All noises in space, and what is far from z = 0 in several passes, none of which knows the heights.
void writeEverywhere(GeneratorBuilder& g) {
    const auto number = g.field<Int>("number"), base = g.field<Int>("base");
    for (const VoxelShape& shape : stampShapes()) g.shape(shape);
    g.pass2D("feet", [&](Pass& p) {
        const Float where = p.random2D("where", p.x(), p.y());
        p.set(number, select(where < 0.02f, Int(where * 200.0f), Int(-1)));
        p.set(base, Int(p.random2D("base", p.x(), p.y()) * 5000.0f) - 2500);
    });
    g.pass3D("solid", [&](Pass& p) {
        const Voronoi3D cells = p.voronoi3D("cells", 19, 3, 3);
        const Float rock = p.perlin3D("rock", 9, {1.0f, .5f, .2f}) + p.simplex3D("grain", 10, {1.0f, .5f});
        const Vec3 slope = p.perlin3DGradient("rock", 9, {1.0f, .5f, .2f});
        const Int bits = floatBits(rock) ^ floatBits(cells.ratio) ^ floatBits(slope.z);
        const Int spot = select(p.randomBool3D("spots", 0.1f, p.x(), p.y(), p.z()), cells.offset.z, Int(0));
        // Much of it is one block.
        const Bool isRock = p.perlin3D("big", 200, {1.0f}) > 0.0f;
        p.setBlock(select(isRock, Block(((bits >> 9) & 3) + spot), Block(Int(7))));
    });
    g.pass3D("stamps", [&](Pass& p) {
        const Block stamp = p.stamp(number, base);
        p.setBlock(select(stamp == p.block("air"), p.blockHere(), stamp));
    });
    g.pass3D("floors", [&](Pass& p) {
        p.if_(p.blockHere() == p.block("air") && floorModulo(p.z(), 5) == 0,
              [&] { p.setBlock(Block(floorDivide(p.z(), 40) & 255)); });
    });
}

TEST(Heights, LayersOfAnyHeightsAreThoseOfTheTallestWorld) {
    const Generator tallest(build(writeEverywhere, {0, kTallest}), kTestSeed);
    for (const ChunkPos pos : {ChunkPos{2, -3}, ChunkPos{world::kMinChunk, world::kMaxChunk}}) {
        const world::Chunk all = tallest.generate(pos);
        for (const Heights heights :
             {Heights{0, 256}, Heights{-64, 320}, Heights{-1024, -512}, Heights{512, 1024}, Heights{-16, 0},
              Heights{-2048, -2032}, Heights{2032, 2048}}) {
            SCOPED_TRACE(world::describe(heights));
            const Generator generator(build(writeEverywhere, {0, heights}), kTestSeed);
            EXPECT_EQ(generator.heights(), heights);
            const world::Chunk chunk = generator.generate(pos);
            ASSERT_EQ(chunk.heights(), heights);
            for (int number = heights.firstSection(); number < heights.endSection(); ++number)
                ASSERT_TRUE(chunk.section(number) == all.section(number)) << "section " << number;
        }
    }
}

TEST(Heights, AreTheSameOnEveryInstructionSet) {
    std::vector<world::Chunk> chunks;
    onEachTarget([&] {
        const Generator generator(build(writeEverywhere, {0, Heights{-512, -256}}), kTestSeed);
        chunks.push_back(generator.generate({1, 2}));
        ASSERT_TRUE(chunks.back() == chunks.front());
    });
}

TEST(Heights, ReadsAndWritesAreClampedIntoTheWorld) {
    for (const Heights heights : kSomeHeights) {
        SCOPED_TRACE(world::describe(heights));
        const auto write = [&](GeneratorBuilder& g) {
            const auto low = g.field<Int>("low"), high = g.field<Int>("high");
            g.pass3D("numbers", [&](Pass& p) {
                p.setBlock(Block(p.z()));
                p.setAt(low, Int(-5000), p.z());
                p.setAt(high, Int(5000), p.z());
            });
            g.pass3D("reads", [&](Pass& p) {
                const Int below(p.blockInColumn(p.z() - 3)), above(p.blockAt({1, -1}, p.z() + 3));
                p.setBlock(Block(below * 3 + above * 5 + p.read(low) * 7 + p.read(high) * 11));
            });
        };
        expectBlocks(
            write,
            [&](std::int32_t, std::int32_t, std::int32_t z) {
                const auto block = [&](int at) { return static_cast<std::uint16_t>(heights.clamp(at)); };
                return block(z - 3) * 3 + block(z + 3) * 5 + heights.bottom * 7 + (heights.top - 1) * 11;
            },
            {0, heights});
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(Heights, ShapesReachIntoAnyWorld) {
    for (const Heights heights : kSomeHeights) {
        const auto write = [&](GeneratorBuilder& g) {
            const auto number = g.field<Int>("number"), base = g.field<Int>("base");
            g.shape({"high", {{"stone", 0}}, {{0, 0, kMaxShapeZ, 0}}});
            g.shape({"low", {{"stone", 0}}, {{0, 0, kMinShapeZ, 0}}});
            g.pass2D("feet", [&](Pass& p) {
                p.set(number, p.x() & 1);
                const Int lowest = g.heights().bottom - kMaxShapeZ,
                          highest = g.heights().top - 1 - kMinShapeZ;
                p.set(base, select((p.x() & 1) == 0, lowest, highest));
            });
            g.pass3D("stamps", [&](Pass& p) { p.setBlock(p.stamp(number, base)); });
        };
        expectBlocks(write,
                     [&](std::int32_t x, std::int32_t, std::int32_t z) {
                         return z == ((x & 1) == 0 ? heights.bottom : heights.top - 1) ? 1 : 0;
                     },
                     {0, heights});
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(Heights, AreDeclaredOrOfTheRequest) {
    const auto declare = [](GeneratorBuilder& g) {
        g.declareHeights({-64, 320});
        g.pass3D("only", [](Pass& p) { p.setBlock(Block(Int(p.heights().top))); });
    };
    EXPECT_EQ(build([](GeneratorBuilder& g) { g.pass3D("only", [](Pass&) {}); }).heights, Heights());
    EXPECT_EQ(build(declare).heights, (Heights{-64, 320}));
    EXPECT_EQ(build(declare, {3, {}}).heights, (Heights{-64, 320}));
    EXPECT_EQ(build(declare, {0, Heights{16, 64}}).heights, (Heights{16, 64}));
    expectBlocks(declare, [](auto, auto, auto) { return 320; });
}

TEST(Heights, MistakesAreNamed) {
    const auto mistake = [](const Write& write, GraphRequest request = {}) {
        const auto graph = tryToBuild(write, request);
        return graph ? "" : graph.error().message;
    };
    const auto stone = [](Pass& p) { p.setBlock(p.block("stone")); };
    const Heights odd = {0, 100}, fine = {0, 64};
    const std::string rule = world::checkHeights(odd).error().message;
    const auto declare = [&](Heights heights) {
        return [&, heights](GeneratorBuilder& g) {
            g.declareHeights(heights);
            g.pass3D("only", stone);
        };
    };
    EXPECT_EQ(mistake(declare(fine)), "");
    EXPECT_THAT(mistake(declare(odd)), HasSubstr(rule));
    EXPECT_THAT(mistake(declare(odd), {0, fine}), HasSubstr(rule));
    EXPECT_THAT(mistake(declare(fine), {0, odd}), HasSubstr(rule));
    EXPECT_THAT(mistake([&](GeneratorBuilder& g) {
                    g.declareHeights(fine);
                    g.declareHeights(fine);
                    g.pass3D("only", stone);
                }),
                HasSubstr("heights are declared twice"));
    EXPECT_THAT(mistake([&](GeneratorBuilder& g) {
                    g.pass3D("only", stone);
                    g.declareHeights(fine);
                }),
                HasSubstr("heights are declared after a pass"));
}

TEST(Heights, ArePartOfTheHashUnlessTheyAreTheUsualOnes) {
    const auto write = [](GeneratorBuilder& g) {
        g.pass3D("only", [](Pass& p) { p.setBlock(Block(p.z())); });
    };
    const std::uint64_t usual = graphHash(build(write));
    EXPECT_EQ(graphHash(build(write, {0, Heights{0, 256}})), usual);
    EXPECT_NE(graphHash(build(write, {0, Heights{-16, 256}})), usual);
    EXPECT_NE(graphHash(build(write, {0, Heights{-16, 256}})),
              graphHash(build(write, {0, Heights{-16, 272}})));
}

TEST(Heights, OfLevelGeneratorsAreThoseOfTheirGraphs) {
    const Heights heights = {-256, 512};
    const auto generators =
        makeLevelGenerators("overworld", contentBlocks(), 3, builtInGenerators(), heights);
    ASSERT_TRUE(generators) << generators.error().message;
    EXPECT_EQ(generators->heights(), heights);
    for (const std::uint8_t level : {0, 2})
        EXPECT_EQ(generators->generate({1, 2, level}).heights(), heights) << int{level};
    EXPECT_EQ(makeLevelGenerators("overworld", contentBlocks(), 3)->heights(), Heights());
    const LevelGenerators others([](int level) { return makeGenerator("flat", contentBlocks(), level); }, 3,
                                 heights);
    EXPECT_THAT(others.at(0).error().message, HasSubstr("flat"));
}

// Results that neighbors need are made by both threads.
TEST(Heights, ThreadsDoNotMatter) {
    const auto write = [](GeneratorBuilder& g) {
        g.pass3D("ground", [](Pass& p) {
            const Bool isRock = Float(p.z()) < p.perlin3D("rock", 30, {1.0f, 2.0f}) * 300.0f;
            p.setBlock(select(isRock, p.block("stone"), p.block("air")));
        });
        g.pass3D("spread", [](Pass& p) { p.setBlock(p.blockAt({16, -16}, p.z() - 700)); });
        g.pass3D("last", [](Pass& p) {
            p.setBlock(
                select(p.blockAt({-9, 3}, p.z() + 20) == p.block("air"), p.block("dirt"), p.blockHere()));
        });
    };
    const Generator alone(build(write, {0, kTallest}), kTestSeed),
        shared(build(write, {0, kTallest}), kTestSeed);
    const int kSide = 3;
    std::vector<world::Chunk> want, made(kSide * kSide);
    for (int k = 0; k < kSide * kSide; ++k) want.push_back(alone.generate({k % kSide, k / kSide}));
    std::atomic<int> next = 0;
    const auto work = [&] {
        for (int k = next++; k < kSide * kSide; k = next++)
            made[static_cast<std::size_t>(k)] = shared.generate({k % kSide, k / kSide});
    };
    std::thread other(work);
    work();
    other.join();
    for (std::size_t k = 0; k < made.size(); ++k) EXPECT_TRUE(made[k] == want[k]) << k;
    // 49 chunks, of whose 256 sections few are not one block.
    EXPECT_LT(shared.cacheBytes(), std::size_t{49} * 2 * 100 * 8192);
}

struct Counted {
    std::map<std::string, int> blocks;
    int operator[](const std::string& name) const {
        const auto found = blocks.find(name);
        return found == blocks.end() ? 0 : found->second;
    }
};

Counted countIn(const Generator& generator, int low, int high) {
    Counted counted;
    for (int k = 0; k < 12; ++k) {
        const world::Chunk chunk = generator.generate({195 + 9 * k, -125 + 7 * k});
        for (int z = low; z < high; ++z)
            for (int lane = 0; lane < 256; ++lane)
                ++counted.blocks
                      [contentBlocks().type(chunk.block(world::blockIndex(lane % 16, lane / 16, z))).name];
    }
    return counted;
}

// The same land around the sea; rock, caves and ore go on below; open sky above.
TEST(Heights, BuiltInGeneratorsGoOnDownward) {
    for (const std::string name : {"overworld", "continents"}) {
        SCOPED_TRACE(name);
        const Generator usual(makeGenerator(name, contentBlocks()).value(), kTestSeed);
        const Generator tall(makeGenerator(name, contentBlocks(), {0, Heights{-512, 1024}}).value(),
                             kTestSeed);
        for (const ChunkPos pos : {ChunkPos{0, 0}, ChunkPos{195, -125}, ChunkPos{226, -122}}) {
            const world::Chunk a = usual.generate(pos), b = tall.generate(pos);
            for (int number = 1; number < 16; ++number)
                ASSERT_TRUE(a.section(number) == b.section(number)) << pos.x << " section " << number;
            for (int number = 16; number < 64; ++number)
                ASSERT_TRUE(b.section(number) == world::Section(world::kAir)) << "section " << number;
        }
        const Counted deep = countIn(tall, -480, -480 + 64), near = countIn(tall, 0, 64);
        EXPECT_GT(deep["glowing_ore"], near["glowing_ore"] / 2);
        EXPECT_GT(deep["air"], near["air"] / 3);
        EXPECT_EQ(deep["water"], 0) << "caves are lakes at the bottom alone";
        const Counted floor = countIn(tall, -512, -510);
        EXPECT_EQ(floor["air"] + floor["water"], 0) << "the lowest layers are closed";
    }
}

TEST(Heights, EveryBuiltInGeneratorHasChunksOfAnyHeights) {
    for (const std::string& name : namesOf(builtInGenerators())) {
        for (const Heights heights :
             {Heights{-64, 320}, Heights{512, 1024}, Heights{-256, 0}, Heights{64, 80}}) {
            for (const int level : {0, 3, 12}) {
                SCOPED_TRACE(name + " " + world::describe(heights));
                auto graph = makeGenerator(name, contentBlocks(), {level, heights});
                ASSERT_TRUE(graph) << graph.error().message;
                const Generator generator(*std::move(graph), 1);
                EXPECT_EQ(generator.generate({1, -1, static_cast<std::uint8_t>(level)}).heights(), heights);
            }
        }
    }
}

// Tall worlds are saved, too: versions make the same blocks.
TEST(Heights, AVersionAlwaysMakesTheSameBlocks) {
    const std::map<std::string, std::string> pinned = {{"overworld", "433d5364c831a6c92818b3b2146e993b"},
                                                       {"continents", "27d4299d9f582c7fe25f4568b5e3818c"},
                                                       {"wilderness", "f21eaecf3db0d1ed337aa61c7fdfbd62"},
                                                       {"flat", "a7cb1b2d0ddc5211c1d10794eda7998a"},
                                                       {"hills3d", "6ef1324ad5a7907e52283c5bc1f65f8f"},
                                                       {"voronoi", "2e6c9ebfa49000940c6457ce22b7e567"}};
    for (const std::string& name : namesOf(builtInGenerators())) {
        base::Digest digest;
        const Generator generator(makeGenerator(name, contentBlocks(), {0, Heights{-128, 384}}).value(),
                                  kTestSeed);
        for (int k = 0; k < 6; ++k) {
            for (const BlockId id : blocksOf(generator.generate({53 * k - 500, 700 - 71 * k}))) {
                digest.update(contentBlocks().type(id).name);
                digest.update(" ");
            }
        }
        EXPECT_TRUE(pinned.contains(name)) << name << " is new: pin its digest " << digest.hex();
        if (!pinned.contains(name)) continue;
        EXPECT_EQ(digest.hex(), pinned.at(name)) << name << ": raise its version in catalogue.cpp";
    }
}

}  // namespace
}  // namespace terrane::gen
