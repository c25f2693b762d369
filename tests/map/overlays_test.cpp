#include "terrane/map/map_painter.h"

#include <set>

#include "terrane/gen/generators/biomes.h"
#include "tests/map/map_fixture.h"
#include "tests/map/painted_columns.h"

namespace terrane::map {
namespace {

TEST(Overlays, HeightsHaveColors) {
    EXPECT_EQ(heightColor(0), (Rgb{10, 16, 60}));
    EXPECT_EQ(heightColor(255), (Rgb{255, 255, 255}));
    EXPECT_GT(heightColor(79).blue, heightColor(79).green) << "the sea";
    EXPECT_GT(heightColor(80).green, heightColor(80).blue) << "the shore";
    for (int z = 1; z < 80; ++z) EXPECT_GE(heightColor(z).blue, heightColor(z - 1).blue) << z;
    for (int z = world::kLowestBottom + 100; z <= 0; ++z)
        EXPECT_LE(heightColor(z - 100).blue, heightColor(z).blue) << "deeper ground is darker";
    EXPECT_LT(heightColor(-1500).blue, heightColor(0).blue);
    for (int z = 256; z < world::kHighestTop; ++z) EXPECT_LE(heightColor(z).green, heightColor(z - 1).green);
    EXPECT_LT(heightColor(1800).green, heightColor(1000).green);
    EXPECT_EQ(heightColor(world::kLowestBottom - 1), heightColor(world::kLowestBottom));
    EXPECT_EQ(heightColor(world::kHighestTop), heightColor(world::kHighestTop - 1));
}

TEST(Overlays, EachBiomeHasAColorOfItsOwn) {
    std::set<int> colors;
    const std::size_t count = gen::Biomes::names().size();
    for (std::size_t k = 0; k < count; ++k) {
        const Rgb color = biomeColor(k);
        colors.insert(color.red << 16 | color.green << 8 | color.blue);
    }
    EXPECT_EQ(colors.size(), count);
    EXPECT_EQ(biomeColor(1000), biomeColor(count - 1)) << "no memory beyond the table is read";
}

TEST(Overlays, GroundUnderWaterCounts) {
    PaintedColumns land(4, 3);
    land.at(1, 1) = {1, 1, 95, 20};
    const base::Image image = paintHeights(land.area());
    ASSERT_EQ(image.width, 4);
    ASSERT_EQ(image.height, 3);
    EXPECT_EQ(land.pixel(image, 1, 1), heightColor(20));
    EXPECT_EQ(land.pixel(image, 3, 2), heightColor(80));
}

// A line is on the higher side of a step over a multiple of 16, seen from the west and the north.
TEST(Overlays, ContoursAreDarker) {
    PaintedColumns land(4, 4);
    land.at(1, 1) = {1, 1, 96, 96};
    land.at(2, 2) = {1, 1, 95, 95};
    const base::Image image = paintHeights(land.area());
    EXPECT_LT(land.pixel(image, 1, 1).green, heightColor(96).green);
    EXPECT_EQ(land.pixel(image, 2, 2), heightColor(95)) << "the same step as 80";
    EXPECT_EQ(land.pixel(image, 0, 1), heightColor(80));
}

TEST(Overlays, BiomesHaveTheirColorsColumnByColumn) {
    const PaintedColumns land(3, 2);
    const std::vector<std::uint8_t> biomes = {3, 0, 0, 0, 5, 7};
    for (const int scale : {1, 2}) {
        const base::Image image = paintBiomes({0, -30, 7, 3, 2}, scale, biomes);
        ASSERT_EQ(image.width, 3 * scale);
        ASSERT_EQ(image.height, 2 * scale);
        EXPECT_EQ(land.pixel(image, 0, 0, scale, scale - 1, scale - 1), biomeColor(3));
        EXPECT_EQ(land.pixel(image, 1, 1, scale), biomeColor(5));
        EXPECT_EQ(land.pixel(image, 2, 1, scale), biomeColor(7));
        EXPECT_EQ(land.pixel(image, 1, 0, scale), biomeColor(0));
    }
}

}  // namespace
}  // namespace terrane::map
