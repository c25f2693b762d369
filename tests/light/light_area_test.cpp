#include "terrane/light/light_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "tests/light/reference_light.h"
#include "tests/support/default_heights.h"

namespace terrane::light {
namespace {

using world::BlockId;
using world::kChunkHeight;
using world::kChunkSize;

void expectReference(const TestArea& area) {
    light::expectReference(area, area.solve());
}

TEST(LightArea, EqualsTheFormulaIteratedUntilStable) {
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        expectReference(TestArea(1, 1, scattered(seed, 1)));
        expectReference(TestArea(1, 1, scattered(seed, 8)));
        expectReference(TestArea(1, 1, layers(seed)));
        expectReference(TestArea(1, 2, caves(seed)));
        expectReference(TestArea(2, 1, scattered(seed, 60)));
        if (HasFailure()) return;
    }
    expectReference(TestArea(2, 2, caves(9)));
}

// Light reaches 15 blocks: blocks beyond the next chunk do not matter.
TEST(LightArea, IsExactOneChunkInside) {
    const TestArea::Source world = caves(4);
    const TestArea small(3, 3, [&](int x, int y, int z) { return world(x + 16, y + 16, z); });
    const TestArea large(5, 5, world);
    const std::vector<LightValue> inSmall = small.solve(), inLarge = large.solve();
    for (int z = 0; z < kChunkHeight; ++z) {
        for (int y = 16; y < 32; ++y) {
            for (int x = 16; x < 32; ++x) {
                ASSERT_EQ(inSmall[small.index(x, y, z)], inLarge[large.index(x + 16, y + 16, z)])
                    << x << ' ' << y << ' ' << z;
            }
        }
    }
}

TEST(LightArea, AirIsDaylightOnly) {
    const TestArea area(1, 1, [](int, int, int) { return world::kAir; });
    for (const LightValue value : area.solve()) ASSERT_EQ(value, 15 << 12);
}

// A layer of one block over the whole area, so that nothing comes from the side.
int daylightBelow(std::string_view name, int layers) {
    const BlockId id = contentBlock(name);
    const TestArea area(1, 1, [&](int, int, int z) { return z >= 50 && z < 50 + layers ? id : world::kAir; });
    const std::vector<LightValue> light = area.solve();
    EXPECT_EQ(levelOf(light[area.index(7, 7, 50 + layers)], 3), 15) << name << " above";
    EXPECT_EQ(levelOf(light[area.index(7, 7, 0)], 3), levelOf(light[area.index(7, 7, 49)], 3))
        << name << ": nothing is lost with distance straight down";
    return levelOf(light[area.index(7, 7, 49)], 3);
}

TEST(LightArea, DaylightLosesTheOpacitiesOfItsColumn) {
    EXPECT_EQ(daylightBelow("stone", 1), 0);
    EXPECT_EQ(daylightBelow("lamp_red", 1), 0);
    EXPECT_EQ(daylightBelow("water", 1), 14);
    EXPECT_EQ(daylightBelow("water", 9), 6);
    EXPECT_EQ(daylightBelow("water", 20), 0);
    EXPECT_EQ(daylightBelow("oak_leaves", 2), 9);
    EXPECT_EQ(daylightBelow("cyan_glass", 4), 3);
    EXPECT_EQ(daylightBelow("cactus", 1), 4);
    EXPECT_EQ(daylightBelow("wheat", 1), 11);
    EXPECT_EQ(daylightBelow("glowing_mushroom", 3), 15);
}

TEST(LightArea, DaylightFadesUnderARoof) {
    const BlockId stone = contentBlock("stone");
    const TestArea area(2, 1, [&](int x, int, int z) { return z == 60 && x >= 8 ? stone : world::kAir; });
    const std::vector<LightValue> light = area.solve();
    for (int x = 0; x < 32; ++x) {
        EXPECT_EQ(levelOf(light[area.index(x, 5, 30)], 3), x < 8 ? 15 : std::max(0, 15 - (x - 7))) << x;
    }
}

// One lamp in the middle of 2 × 2 chunks, in `medium`.
struct LampLight {
    LampLight(std::string_view lamp, std::string_view medium)
        : area(2, 2,
               [&](int x, int y, int z) {
                   if (x == 16 && y == 16 && z == 100) return contentBlock(lamp);
                   return medium.empty() ? world::kAir : contentBlock(medium);
               }),
          light(area.solve()) {}

    std::array<int, 3> at(int dx, int dy, int dz) const {
        const LightValue value = light[area.index(16 + dx, 16 + dy, 100 + dz)];
        return {levelOf(value, 0), levelOf(value, 1), levelOf(value, 2)};
    }

    TestArea area;
    std::vector<LightValue> light;
};

using Color = std::array<int, 3>;

TEST(LightArea, LampFallsOffByOneABlock) {
    const LampLight white("lamp_white", "");
    EXPECT_EQ(white.at(0, 0, 0), (Color{15, 13, 13}));
    EXPECT_EQ(white.at(1, 0, 0), (Color{14, 12, 12}));
    EXPECT_EQ(white.at(-3, 0, 0), (Color{12, 10, 10}));
    EXPECT_EQ(white.at(2, -3, 4), (Color{6, 4, 4}));
    EXPECT_EQ(white.at(0, 0, 13), (Color{2, 0, 0}));
    EXPECT_EQ(white.at(0, -14, 0), (Color{1, 0, 0}));
    EXPECT_EQ(white.at(7, 0, -8), (Color{0, 0, 0}));
    EXPECT_EQ(LampLight("lamp_green", "").at(0, 5, 0), (Color{0, 10, 0}));
    EXPECT_EQ(LampLight("lamp_blue", "").at(0, 0, -5), (Color{0, 0, 10}));
    EXPECT_EQ(LampLight("glowing_mushroom", "").at(1, 1, 0), (Color{3, 8, 6}));
}

TEST(LightArea, LampFallsOffByOpacityAsWell) {
    const LampLight inWater("lamp_red", "water");
    for (int d = 0; d < 15; ++d) EXPECT_EQ(inWater.at(d, 0, 0), (Color{std::max(0, 15 - 2 * d), 0, 0}));
    EXPECT_EQ(LampLight("lamp_red", "oak_leaves").at(0, 3, 0), (Color{3, 0, 0}));
    EXPECT_EQ(LampLight("lamp_red", "stone").at(1, 0, 0), (Color{0, 0, 0}));
}

TEST(LightArea, ColorsDoNotMix) {
    const TestArea area(2, 1, [](int x, int y, int z) {
        if (y != 8 || z != 100) return world::kAir;
        return x == 8 ? contentBlock("lamp_red") : x == 18 ? contentBlock("lamp_blue") : world::kAir;
    });
    const std::vector<LightValue> light = area.solve();
    EXPECT_EQ(light[area.index(13, 8, 100)], 15 << 12 | 10 << 8 | 10);
    EXPECT_EQ(light[area.index(9, 8, 100)], 15 << 12 | 6 << 8 | 14);
}

TEST(LightArea, NeedsTheChunksOfItsSize) {
    const LightTable table(contentBlocks());
    const world::Chunk chunk;
    EXPECT_THROW(lightArea({.chunksX = 2, .chunksY = 1, .chunks = {&chunk}}, table), std::invalid_argument);
    EXPECT_THROW(lightArea({.chunksX = -1, .chunksY = -1, .chunks = {&chunk}}, table), std::invalid_argument);
    EXPECT_THROW(lightArea({.chunksX = 0, .chunksY = 0, .chunks = {}}, table), std::invalid_argument);
    EXPECT_THROW(lightArea({.chunksX = 1, .chunksY = 2, .chunks = {&chunk, nullptr}}, table),
                 std::invalid_argument);
    LightScratch scratch;
    EXPECT_THROW(lightChunk({}, scratch), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::light
