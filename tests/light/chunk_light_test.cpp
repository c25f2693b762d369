#include "terrane/light/chunk_light.h"
#include "tests/support/default_heights.h"

#include <gtest/gtest.h>

#include <array>

namespace terrane::light {
namespace {

TEST(ChunkLight, IsDarkAtFirst) {
    const ChunkLight light;
    EXPECT_EQ(light.get(0, 0, 0), kDark);
    EXPECT_EQ(light.get(15, 15, 255), kDark);
}

TEST(ChunkLight, HoldsBricksFromBelow) {
    std::array<LightValue, world::kBlocksPerSection> values{};
    values[3 + 16 * 4 + 256 * 5] = 0xF123;
    ChunkLight light;
    light.setBrick(2, LightBrick::fromValues(values));
    light.setBrick(15, LightBrick(kFullDaylight));
    EXPECT_EQ(light.get(3, 4, 32 + 5), 0xF123);
    EXPECT_EQ(light.get(4, 4, 32 + 5), kDark);
    EXPECT_EQ(light.at(world::blockIndex(3, 4, 37)), 0xF123);
    EXPECT_EQ(light.get(0, 0, 239), kDark);
    EXPECT_EQ(light.get(0, 0, 240), kFullDaylight);
    EXPECT_TRUE(light.brick(15).isUniform());
}

TEST(ChunkLight, UniformBricksTakeEightBytes) {
    ChunkLight light;
    for (int k = 0; k < world::kSectionsPerChunk; ++k) light.setBrick(k, LightBrick(kFullDaylight));
    constexpr std::size_t kUniform = sizeof(ChunkLight) + 16 * 8;
    EXPECT_EQ(light.memoryBytes(), kUniform);
    std::array<LightValue, world::kBlocksPerSection> values{};
    values[0] = 1;  // two values: one bit a block
    light.setBrick(0, LightBrick::fromValues(values));
    EXPECT_GE(light.memoryBytes(), kUniform + 512 + 2 * sizeof(LightValue));
    EXPECT_LT(light.memoryBytes(), kUniform + 600);
}

TEST(ChunkLight, HasTheHeightsOfItsWorld) {
    ChunkLight light({-64, 320});
    EXPECT_EQ(light.heights(), (world::Heights{-64, 320}));
    EXPECT_EQ(light.get(15, 15, -64), kDark);
    light.setBrick(-4, LightBrick(7));
    light.setBrick(19, LightBrick(kFullDaylight));
    EXPECT_EQ(light.get(0, 0, -64), 7);
    EXPECT_EQ(light.get(0, 0, -49), 7);
    EXPECT_EQ(light.get(0, 0, -48), kDark);
    EXPECT_EQ(light.get(15, 15, 319), kFullDaylight);
    EXPECT_EQ(light.memoryBytes(), sizeof(ChunkLight) + 24 * sizeof(LightBrick));
    EXPECT_FALSE(light == ChunkLight());
    EXPECT_FALSE(ChunkLight() == ChunkLight({16, 272})) << "dark as well, at other heights";
}

TEST(ChunkLight, ComparesValues) {
    ChunkLight a, b;
    EXPECT_TRUE(a == b);
    b.setBrick(7, LightBrick(1));
    EXPECT_FALSE(a == b);
}

}  // namespace
}  // namespace terrane::light
