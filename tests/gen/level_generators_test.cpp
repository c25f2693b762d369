#include "terrane/gen/level_generators.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

base::Result<GeneratorGraph> hills(int level) {
    GeneratorBuilder g("hills", testBlocks(), level);
    const auto height = g.field<Float>("height");
    g.pass2D("hills", [&](Pass& p) { p.set(height, p.perlin2D("hills", 64, {1.0f}) * 20.0f + 60.0f); });
    g.pass3D("ground", [&](Pass& p) {
        p.setBlock(select(Float(p.z()) < p.readAt(height, {9, -3}), p.block("stone"), p.block("air")));
    });
    return g.finish();
}

ChunkPos posOf(int level) {
    return {3, -2, static_cast<std::uint8_t>(level)};
}

TEST(LevelGenerators, EveryLevelHasTheChunksOfItsGenerator) {
    const LevelGenerators generators(hills, kTestSeed);
    for (int level = 0; level <= world::kMaxLevel; ++level) {
        const Generator one(hills(level).value(), kTestSeed);
        EXPECT_TRUE(generators.generate(posOf(level)) == one.generate(posOf(level))) << level;
        ASSERT_TRUE(generators.at(level));
        EXPECT_EQ((*generators.at(level))->level(), level);
    }
}

TEST(LevelGenerators, AGraphIsMadeOnceAndOnlyWhenAskedFor) {
    std::vector<int> made;
    const LevelGenerators generators(
        [&](int level) {
            made.push_back(level);
            return hills(level);
        },
        kTestSeed);
    EXPECT_TRUE(made.empty());
    for (const int level : {2, 0, 2, 2, 0}) static_cast<void>(generators.generate(posOf(level)));
    EXPECT_EQ(made, (std::vector<int>{2, 0}));
}

TEST(LevelGenerators, ThreadsMayAskAtOnce) {
    const LevelGenerators generators(hills, kTestSeed);
    const world::Chunk expected = Generator(hills(3).value(), kTestSeed).generate(posOf(3));
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 6; ++t) {
        threads.emplace_back([&] { wrong += !(generators.generate(posOf(3)) == expected); });
    }
    for (std::thread& t : threads) t.join();
    EXPECT_EQ(wrong, 0);
}

TEST(LevelGenerators, WhatCannotBeMadeIsRefusedByName) {
    const LevelGenerators generators(
        [](int level) -> base::Result<GeneratorGraph> {
            if (level == 4) return base::fail("no moor at level 4");
            return hills(level);
        },
        kTestSeed);
    EXPECT_EQ(generators.at(4).error().message, "no moor at level 4");
    EXPECT_EQ(generators.at(-1).error().message, "level -1 is not in 0…15");
    EXPECT_FALSE(generators.at(world::kMaxLevel + 1));
    EXPECT_THROW(static_cast<void>(generators.generate(posOf(4))), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(generators.generate({world::kMaxChunk, 0, 1})), std::invalid_argument);
    EXPECT_TRUE(generators.at(5)) << "others go on";
}

}  // namespace
}  // namespace terrane::gen
