#include "terrane/light/light_sources.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/light/test_area.h"

namespace terrane::light {
namespace {

using world::blockIndex;
using world::Heights;

const BrickRun& runAt(const ChunkBricks& bricks, int z) {
    return *std::find_if(bricks.begin(), bricks.end(),
                         [&](const BrickRun& run) { return run.lowest <= z >> 4; });
}

LightValue lightAt(const ChunkBricks& bricks, int x, int y, int z) {
    return runAt(bricks, z).light.values[blockIndex(x, y, z) & 4095];
}

LightValue opacityAt(const ChunkBricks& bricks, int x, int y, int z) {
    return runAt(bricks, z).opacity.values[blockIndex(x, y, z) & 4095];
}

// The runs lie on each other from the top to the bottom.
void expectWhole(const ChunkBricks& bricks, Heights heights) {
    int above = heights.endSection();
    for (const BrickRun& run : bricks) {
        EXPECT_EQ(run.highest, above - 1);
        EXPECT_LE(run.lowest, run.highest);
        EXPECT_TRUE(run.lowest == run.highest || (run.light.isUniform && run.opacity.isUniform));
        above = run.lowest;
    }
    EXPECT_EQ(above, heights.firstSection());
}

TEST(LightSources, OfAirIsDaylight) {
    for (const Heights heights : {Heights(), Heights{-2048, 2048}, Heights{512, 528}}) {
        BrickPool pool;
        const ChunkBricks bricks = findSources(world::Chunk(heights), contentTable(), pool);
        ASSERT_EQ(bricks.size(), 1u);
        expectWhole(bricks, heights);
        EXPECT_TRUE(bricks[0].light.isUniform);
        EXPECT_EQ(bricks[0].light.uniformValue(), kFullDaylight);
        EXPECT_EQ(bricks[0].opacity.uniformValue(), 0);
    }
}

TEST(LightSources, DaylightFallsByOpacity) {
    for (const int low : {0, -2048, 1024}) {
        const Heights heights{low, low + 1024};
        world::Chunk chunk(heights);
        chunk.setBlock(blockIndex(1, 2, low + 200), contentBlock("oak_leaves"));
        chunk.setBlock(blockIndex(1, 2, low + 100), contentBlock("lamp_red"));
        BrickPool pool;
        const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
        expectWhole(bricks, heights);
        EXPECT_EQ(lightAt(bricks, 1, 2, low + 201), 15 << 12);
        EXPECT_EQ(lightAt(bricks, 1, 2, low + 200), 12 << 12);
        EXPECT_EQ(lightAt(bricks, 1, 2, low + 101), 12 << 12);
        EXPECT_EQ(lightAt(bricks, 1, 2, low + 100), 15);  // the lamp is opaque
        EXPECT_EQ(lightAt(bricks, 1, 2, low + 99), 0);
        EXPECT_EQ(lightAt(bricks, 1, 2, low), 0);
        EXPECT_EQ(lightAt(bricks, 2, 2, low + 99), 15 << 12);
        EXPECT_EQ(opacityAt(bricks, 1, 2, low + 200), 0x3333);
        EXPECT_EQ(opacityAt(bricks, 1, 2, low + 100), 0xFFFF);
    }
}

TEST(LightSources, UnderGroundBricksOfOneValueAreOneRun) {
    const auto stone = contentBlock("stone"), dirt = contentBlock("dirt");
    const world::Chunk chunk = TestArea::makeChunk(
        0, 0, [&](int x, int, int z) { return z >= 64 ? world::kAir
                                              : x % 2 ? stone
                                                      : dirt; }, {-512, 256});
    BrickPool pool;
    const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
    ASSERT_EQ(bricks.size(), 2u);
    expectWhole(bricks, {-512, 256});
    EXPECT_EQ(bricks[1].highest, 3);
    EXPECT_EQ(bricks[1].light.uniformValue(), kDark);
    EXPECT_EQ(bricks[1].opacity.uniformValue(), 0xFFFF);
}

TEST(LightSources, NoDaylightPassesSolidBricks) {
    const auto stone = contentBlock("stone");
    const world::Chunk chunk =
        TestArea::makeChunk(0, 0, [&](int, int, int z) { return z >= 32 && z < 48 ? stone : world::kAir; });
    BrickPool pool;
    const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
    EXPECT_EQ(bricks.size(), 3u);
    EXPECT_EQ(lightAt(bricks, 5, 5, 48), kFullDaylight);
    EXPECT_EQ(lightAt(bricks, 5, 5, 47), kDark);
    EXPECT_EQ(lightAt(bricks, 5, 5, 31), kDark);
    EXPECT_EQ(lightAt(bricks, 5, 5, 0), kDark);
}

// Below half a roof the columns differ, in every section down to the bottom.
TEST(LightSources, ShadowsFallThroughEqualSections) {
    const auto stone = contentBlock("stone");
    const world::Chunk chunk = TestArea::makeChunk(
        0, 0, [&](int x, int, int z) { return z == 200 && x < 8 ? stone : world::kAir; }, {-256, 256});
    BrickPool pool;
    const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
    expectWhole(bricks, {-256, 256});
    for (int z = -256; z < 200; ++z) {
        ASSERT_EQ(lightAt(bricks, 7, 3, z), kDark) << z;
        ASSERT_EQ(lightAt(bricks, 8, 3, z), kFullDaylight) << z;
    }
}

// Deep water: each block takes one level.
TEST(LightSources, DaylightFadesInUniformWater) {
    const auto water = contentBlock("water");
    const world::Chunk chunk =
        TestArea::makeChunk(0, 0, [&](int, int, int z) { return z < 80 ? water : world::kAir; }, {-128, 256});
    BrickPool pool;
    const ChunkBricks bricks = findSources(chunk, contentTable(), pool);
    expectWhole(bricks, {-128, 256});
    EXPECT_EQ(lightAt(bricks, 0, 0, 79), 14 << 12);
    EXPECT_EQ(lightAt(bricks, 15, 15, 66), 1 << 12);
    EXPECT_EQ(lightAt(bricks, 15, 15, 65), kDark);
    EXPECT_TRUE(runAt(bricks, 63).light.isUniform);
    EXPECT_EQ(runAt(bricks, 63).lowest, -8);
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
    EXPECT_EQ(opacityAt(bricks, 3, 4, 5), missing);
}

// A shaft is sunlit to the bottom; without it the rock below the surface is left out.
TEST(LightSources, SunlitOnesEndInTheDark) {
    const auto stone = contentBlock("stone");
    const auto rock = [&](int, int, int z) { return z < 90 ? stone : world::kAir; };
    const Heights heights{-1024, 1024};
    world::Chunk chunk = TestArea::makeChunk(0, 0, rock, heights);
    BrickPool pool;
    const ChunkBricks closed = findSunlitSources(chunk, contentTable(), pool);
    EXPECT_EQ(closed.back().lowest, 5);
    for (int z = heights.bottom; z < 90; ++z) chunk.setBlock(blockIndex(3, 4, z), world::kAir);
    const ChunkBricks open = findSunlitSources(chunk, contentTable(), pool);
    expectWhole(open, heights);
    EXPECT_EQ(lightAt(open, 3, 4, -1024), kFullDaylight);
    EXPECT_EQ(lightAt(open, 4, 4, -1024), kDark);
    EXPECT_TRUE(findSunlitSources(TestArea::makeChunk(
                                      0, 0, [&](int, int, int) { return stone; }, heights),
                                  contentTable(), pool)
                    .size() == 1);
}

}  // namespace
}  // namespace terrane::light
