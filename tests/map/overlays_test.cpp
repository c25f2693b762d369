#include "terrane/map/map_painter.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "terrane/gen/generators/catalogue.h"
#include "tests/map/map_fixture.h"
#include "tests/map/painted_columns.h"

namespace terrane::map {
namespace {

TEST(Overlays, HeightsHaveColors) {
    const auto color = [](int z) { return heightColor(z, 80); };
    EXPECT_EQ(color(0), (Rgb{10, 16, 60}));
    EXPECT_EQ(color(255), (Rgb{255, 255, 255}));
    EXPECT_GT(color(79).blue, color(79).green) << "the sea";
    EXPECT_GT(color(80).green, color(80).blue) << "the shore";
    for (int z = 1; z < 80; ++z) EXPECT_GE(color(z).blue, color(z - 1).blue) << z;
    for (int z = world::kLowestBottom + 100; z <= 0; ++z)
        EXPECT_LE(color(z - 100).blue, color(z).blue) << "deeper ground is darker";
    EXPECT_LT(color(-1500).blue, color(0).blue);
    for (int z = 256; z < world::kHighestTop; ++z) EXPECT_LE(color(z).green, color(z - 1).green);
    EXPECT_LT(color(1800).green, color(1000).green);
    EXPECT_EQ(color(world::kLowestBottom - 1), color(world::kLowestBottom));
    EXPECT_EQ(color(world::kHighestTop), color(world::kHighestTop - 1));
}

TEST(Overlays, HeightsCountFromTheSea) {
    for (const int rise : {-2000, -400, -81, -80, -1, 0, 1, 60, 200, 1700})
        EXPECT_EQ(heightColor(rise, 0), heightColor(80 + rise, 80)) << rise;
}

TEST(Overlays, EachBiomeHasAColorOfItsOwn) {
    for (const gen::CatalogueEntry& entry : gen::builtInGenerators()) {
        std::set<int> colors;
        for (const std::string_view name : entry.biomes) {
            const Rgb color = biomeColor(name);
            EXPECT_NE(color, biomeColor("no such biome")) << entry.name << " has no color for " << name;
            colors.insert(color.red << 16 | color.green << 8 | color.blue);
            for (const std::string_view other : entry.biomes) {
                if (name == other) continue;
                const Rgb far = biomeColor(other);
                const int difference = std::abs(color.red - far.red) + std::abs(color.green - far.green) +
                                       std::abs(color.blue - far.blue);
                EXPECT_GE(difference, 30) << name << " looks like " << other;
            }
        }
        EXPECT_EQ(colors.size(), entry.biomes.size()) << entry.name;
    }
}

TEST(Overlays, GroundUnderWaterCounts) {
    PaintedColumns land(4, 3);
    land.at(1, 1) = {1, 1, 95, 20};
    const base::Image image = paintHeights(land.area(), 80);
    ASSERT_EQ(image.width, 4);
    ASSERT_EQ(image.height, 3);
    EXPECT_EQ(land.pixel(image, 1, 1), heightColor(20, 80));
    EXPECT_EQ(land.pixel(image, 3, 2), heightColor(80, 80));
}

// A line is on the higher side of a step over a multiple of 16, seen from the west and the north.
TEST(Overlays, ContoursAreDarker) {
    PaintedColumns land(4, 4);
    land.at(1, 1) = {1, 1, 96, 96};
    land.at(2, 2) = {1, 1, 95, 95};
    const base::Image image = paintHeights(land.area(), 80);
    EXPECT_LT(land.pixel(image, 1, 1).green, heightColor(96, 80).green);
    EXPECT_EQ(land.pixel(image, 2, 2), heightColor(95, 80)) << "the same step as 80";
    EXPECT_EQ(land.pixel(image, 0, 1), heightColor(80, 80));
}

// Lines of steep, tall land stay apart at any scale; those of a world of 256 layers are every 16 blocks.
TEST(Overlays, ContoursOfTallLandStayApart) {
    const world::Heights tall{-512, 1792};
    for (int level = 0; level <= 10; ++level) {
        EXPECT_EQ(contourSteps(level, {}), ContourSteps()) << level;
        const ContourSteps steps = contourSteps(level, tall);
        EXPECT_TRUE(steps.line >= 8 << level || steps.line == 128) << level;
        EXPECT_EQ(steps.thick, 4 * steps.line);
        EXPECT_EQ(steps.line % contourSteps(std::max(level - 1, 0), tall).line, 0);
    }
    EXPECT_EQ(contourSteps(0, tall).line, 16);
}

// Thick lines are darker, and wherever the higher ground is.
TEST(Overlays, SomeContoursAreThick) {
    PaintedColumns land(4, 4);
    for (int x = 0; x < 4; ++x) land.at(x, 1) = {1, 1, 130, 130};
    land.at(1, 2) = {1, 1, 100, 100};
    const base::Image image = paintHeights(land.area(), 80, {32, 128});
    const auto shareAt = [&](int x, int y, int z) {
        return static_cast<float>(land.pixel(image, x, y).green) / heightColor(z, 80).green;
    };
    EXPECT_LT(shareAt(0, 1, 130), 0.5f) << "over 128";
    EXPECT_GT(shareAt(1, 2, 100), 0.5f) << "over 96";
    EXPECT_LT(shareAt(1, 2, 100), 0.7f);
    EXPECT_EQ(shareAt(3, 3, 80), 1);
}

TEST(Overlays, BiomesHaveTheirColorsColumnByColumn) {
    const PaintedColumns land(3, 2);
    const std::vector<std::uint8_t> biomes = {3, 0, 0, 0, 2, 1};
    const std::vector<Rgb> colors = {{1, 2, 3}, {40, 50, 60}, {70, 80, 90}, {100, 110, 120}};
    for (const int scale : {1, 2}) {
        const base::Image image = paintBiomes({0, -30, 7, 3, 2}, scale, biomes, colors);
        ASSERT_EQ(image.width, 3 * scale);
        ASSERT_EQ(image.height, 2 * scale);
        EXPECT_EQ(land.pixel(image, 0, 0, scale, scale - 1, scale - 1), colors[3]);
        EXPECT_EQ(land.pixel(image, 1, 1, scale), colors[2]);
        EXPECT_EQ(land.pixel(image, 2, 1, scale), colors[1]);
        EXPECT_EQ(land.pixel(image, 1, 0, scale), colors[0]);
    }
}

}  // namespace
}  // namespace terrane::map
