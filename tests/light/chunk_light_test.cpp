#include "terrane/light/chunk_light.h"

#include <gtest/gtest.h>

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

TEST(ChunkLight, UniformBricksTakeNoMemoryBesideTheObject) {
    ChunkLight light;
    for (int k = 0; k < world::kSectionsPerChunk; ++k) light.setBrick(k, LightBrick(kFullDaylight));
    EXPECT_EQ(light.memoryBytes(), sizeof(ChunkLight));
    std::array<LightValue, world::kBlocksPerSection> values{};
    values[0] = 1;  // two values: one bit a block
    light.setBrick(0, LightBrick::fromValues(values));
    EXPECT_EQ(light.memoryBytes(), sizeof(ChunkLight) + 512 + 2 * sizeof(LightValue));
}

TEST(ChunkLight, ComparesValues) {
    ChunkLight a, b;
    EXPECT_TRUE(a == b);
    b.setBrick(7, LightBrick(1));
    EXPECT_FALSE(a == b);
}

}  // namespace
}  // namespace terrane::light
