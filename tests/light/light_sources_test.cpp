#include "terrane/light/light_sources.h"

#include <gtest/gtest.h>

#include "tests/light/test_area.h"

namespace terrane::light {
namespace {

using world::blockIndex;

LightValue at(const std::array<BrickView, world::kSectionsPerChunk>& bricks, int x, int y, int z) {
    return bricks[static_cast<std::size_t>(z / 16)].values[blockIndex(x, y, z) & 4095];
}

TEST(LightSources, OfAirIsDaylight) {
    BrickPool pool;
    const ChunkBricks bricks = findSources(world::Chunk(), contentTable(), pool);
    for (int k = 0; k < world::kSectionsPerChunk; ++k) {
        EXPECT_TRUE(bricks.light[static_cast<std::size_t>(k)].isUniform);
        EXPECT_EQ(bricks.light[static_cast<std::size_t>(k)].uniformValue(), kFullDaylight);
        EXPECT_EQ(bricks.opacity[static_cast<std::size_t>(k)].uniformValue(), 0);
    }
}

TEST(LightSources, DaylightFallsByOpacity) {
    world::Chunk chunk;
    chunk.setBlock(blockIndex(1, 2, 200), contentBlock("oak_leaves"));
    chunk.setBlock(blockIndex(1, 2, 100), contentBlock("lamp_red"));
    BrickPool pool;
    const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
    EXPECT_EQ(at(bricks.light, 1, 2, 201), 15 << 12);
    EXPECT_EQ(at(bricks.light, 1, 2, 200), 12 << 12);
    EXPECT_EQ(at(bricks.light, 1, 2, 101), 12 << 12);
    EXPECT_EQ(at(bricks.light, 1, 2, 100), 15);  // the lamp is opaque
    EXPECT_EQ(at(bricks.light, 1, 2, 99), 0);
    EXPECT_EQ(at(bricks.light, 2, 2, 99), 15 << 12);
    EXPECT_EQ(at(bricks.opacity, 1, 2, 200), 0x3333);
    EXPECT_EQ(at(bricks.opacity, 1, 2, 100), 0xFFFF);
}

TEST(LightSources, UnderGroundBricksOfOneValueStayUniform) {
    const auto stone = contentBlock("stone"), dirt = contentBlock("dirt");
    const world::Chunk chunk = TestArea::makeChunk(0, 0, [&](int x, int, int z) {
        return z >= 64 ? world::kAir : x % 2 ? stone : dirt;
    });
    BrickPool pool;
    const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_TRUE(bricks.light[k].isUniform && bricks.opacity[k].isUniform);
        EXPECT_EQ(bricks.light[k].uniformValue(), kDark);
    }
}

TEST(LightSources, NoDaylightPassesSolidBricks) {
    const auto stone = contentBlock("stone");
    const world::Chunk chunk =
        TestArea::makeChunk(0, 0, [&](int, int, int z) { return z >= 32 && z < 48 ? stone : world::kAir; });
    BrickPool pool;
    const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
    EXPECT_EQ(at(bricks.light, 5, 5, 48), kFullDaylight);
    EXPECT_EQ(at(bricks.light, 5, 5, 47), kDark);
    EXPECT_EQ(at(bricks.light, 5, 5, 31), kDark);
    EXPECT_EQ(at(bricks.light, 5, 5, 0), kDark);
}

// Deep water: each block takes one level.
TEST(LightSources, DaylightFadesInUniformWater) {
    const auto water = contentBlock("water");
    const world::Chunk chunk =
        TestArea::makeChunk(0, 0, [&](int, int, int z) { return z < 80 ? water : world::kAir; });
    BrickPool pool;
    const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
    EXPECT_EQ(at(bricks.light, 0, 0, 79), 14 << 12);
    EXPECT_EQ(at(bricks.light, 15, 15, 66), 1 << 12);
    EXPECT_EQ(at(bricks.light, 15, 15, 65), kDark);
    EXPECT_TRUE(bricks.light[3].isUniform);
}

// More than 256 kinds of blocks: no palette.
TEST(LightSources, ReadsDenseSections) {
    const world::Chunk chunk = TestArea::makeChunk(0, 0, [](int x, int y, int z) {
        return z < 16 ? static_cast<world::BlockId>(1000 + x + 16 * y + 256 * z) : world::kAir;
    });
    ASSERT_TRUE(chunk.section(0).isDense());
    BrickPool pool;
    const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
    const LightValue missing = contentTable().opacity(contentBlocks().missing());
    EXPECT_EQ(at(bricks.opacity, 3, 4, 5), missing);
}

TEST(LightSources, EndAtTheLowestBrickAskedFor) {
    BrickPool pool;
    const ChunkBricks bricks = findSources(world::Chunk(), contentTable(), pool, 9);
    EXPECT_EQ(bricks.light[8].values, nullptr);
    EXPECT_NE(bricks.light[9].values, nullptr);
}

}  // namespace
}  // namespace terrane::light
