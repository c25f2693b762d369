#include "terrane/gen/batch_generator.h"

#include <gtest/gtest.h>

#include "tests/gen/batch_generator_cases.h"
#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

void writeHills(GeneratorBuilder& g) {
    const auto height = g.field<Float>("height");
    g.pass2D("hills", [&](Pass& p) { p.set(height, p.perlin2D("hills", 7, {1.0f}) * 20.0f + 60.0f); });
    g.pass3D("ground", [&](Pass& p) {
        p.setBlock(select(Float(p.z()) < p.readAt(height, {9, -3}), p.block("stone"), p.block("air")));
    });
}

TEST(BatchGenerator, OneThreadDoesWhatEveryBackEndDoes) {
    const Generator expected(build(writeHills), kTestSeed);
    const auto batches = makeCpuGenerator(Generator(build(writeHills), kTestSeed), 1);
    EXPECT_EQ(batches->backend(), "cpu");
    expectBatchGeneratorCases(*batches, expected);
}

TEST(BatchGenerator, ThreadsDoWhatEveryBackEndDoes) {
    const Generator expected(build(writeHills), kTestSeed);
    for (const unsigned threads : {2u, 5u}) {
        const auto batches = makeCpuGenerator(Generator(build(writeHills), kTestSeed), threads);
        expectBatchGeneratorCases(*batches, expected);
    }
}

TEST(BatchGenerator, MayBeDestroyedWhileBatchesAreInFlight) {
    for (int round = 0; round < 20; ++round) {
        const auto batches = makeCpuGenerator(Generator(build(writeHills), kTestSeed), 3);
        const std::vector<world::ChunkPos> positions = chunksInSquare({0, 0}, 4);
        EXPECT_EQ(batches->submit(positions), positions.size());
        EXPECT_EQ(batches->submit(positions), positions.size());
    }
}

TEST(Generator, RefusesOtherLevels) {
    const Generator generator(build(writeHills), kTestSeed);
    EXPECT_THROW(generator.generate({0, 0, 1}), std::invalid_argument);
    EXPECT_THROW(generator.generate({world::kMaxChunk + 1, 0}), std::invalid_argument);
    EXPECT_TRUE(isGenerated({world::kMaxChunk, world::kMinChunk}));
    EXPECT_EQ(checkGenerated({1, 2, 3}).error().message,
              "chunk 1,2 of level 3: this generator makes level 0 only");
    EXPECT_EQ(checkGenerated({1, 2, 0}, 3).error().message,
              "chunk 1,2 of level 0: this generator makes level 3 only");
    EXPECT_TRUE(isGenerated({world::kMaxChunk >> 3, world::kMinChunk >> 3, 3}, 3));
    EXPECT_EQ(checkGenerated({world::kMaxChunk, 2, 3}, 3).error().message,
              "chunk 134217727,2 of level 3: outside of the world, -16777216 to 16777215");
}

}  // namespace
}  // namespace terrane::gen
