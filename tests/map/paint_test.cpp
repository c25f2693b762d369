#include "terrane/map/paint.h"

#include "tests/map/map_fixture.h"
#include "tests/map/painted_columns.h"

namespace terrane::map {
namespace {

constexpr world::BlockId kStone = 1, kWater = 2, kGrass = 3, kLamp = 4, kUnknown = 99;

MapColors someColors() {
    MapColors colors(5);
    for (BlockColor& color : colors) color.texels.fill(glm::vec3(1));
    colors[kStone].mean = glm::vec3(0.5f);
    colors[kWater].mean = {0.1f, 0.2f, 0.8f};
    colors[kWater].kind = SurfaceKind::Liquid;
    colors[kGrass].mean = {0.4f, 0.6f, 0.3f};
    colors[kGrass].isTinted = true;
    colors[kLamp].mean = glm::vec3(0.9f);
    colors[kLamp].emission = {1, 0.5f, 0};
    colors[kLamp].reach = 14;
    return colors;
}

const Rgb kFlatStone = rgbOf(glm::vec3(0.5f));

TEST(Paint, FlatLandHasTheColorsOfItsBlocks) {
    PaintedColumns land(5, 4);
    land.at(2, 1) = {kLamp, kLamp, 80, 80};
    const base::Image image = paintDay(land.area(), someColors());
    ASSERT_EQ(image.width, 5);
    ASSERT_EQ(image.height, 4);
    EXPECT_EQ(land.pixel(image, 0, 0), kFlatStone);
    EXPECT_EQ(land.pixel(image, 2, 1), rgbOf(glm::vec3(0.9f)));
    for (std::size_t k = 3; k < image.rgba.size(); k += 4) EXPECT_EQ(image.rgba[k], 255) << "opaque";
}

// Light comes from the northwest: slopes that rise toward the southeast are lit.
TEST(Paint, SlopesAreLitFromTheNorthwest) {
    PaintedColumns land(3, 3);
    // A step up toward the east (smaller x), and one down.
    land.at(1, 1) = {kStone, kStone, 84, 84};
    const base::Image image = paintDay(land.area(), someColors());
    EXPECT_GT(land.pixel(image, 1, 1).red, kFlatStone.red)
        << "higher than its neighbors in the west and north";
    EXPECT_LT(land.pixel(image, 0, 1).red, kFlatStone.red) << "behind it, in the east";
    EXPECT_LT(land.pixel(image, 1, 2).red, kFlatStone.red) << "behind it, in the south";
    EXPECT_EQ(land.pixel(image, 2, 1), kFlatStone) << "in the west";
}

TEST(Paint, WaterGetsDarkerWithItsDepth) {
    PaintedColumns land(3, 1);
    land.at(0, 0) = {kWater, kStone, 80, 79};
    land.at(1, 0) = {kWater, kStone, 80, 40};
    land.at(2, 0) = {kWater, world::kAir, 80, 0};
    const base::Image image = paintDay(land.area(), someColors());
    EXPECT_GT(land.pixel(image, 0, 0).blue, land.pixel(image, 1, 0).blue);
    EXPECT_GT(land.pixel(image, 0, 0).red, land.pixel(image, 1, 0).red) << "the ground is seen through it";
    const glm::vec3 water(0.1f, 0.2f, 0.8f);
    EXPECT_LT(throughLiquid(water, glm::vec3(0.5f), 200).z, throughLiquid(water, glm::vec3(0.5f), 10).z);
    EXPECT_EQ(rgbOf(throughLiquid(water, glm::vec3(0.5f), 200)),
              rgbOf(throughLiquid(water, glm::vec3(0.9f), 200)));
}

TEST(Paint, BlocksBeyondTheTableAreGray) {
    PaintedColumns land(1, 1);
    land.at(0, 0) = {kUnknown, kUnknown, 80, 80};
    EXPECT_EQ(land.pixel(paintDay(land.area(), someColors()), 0, 0), rgbOf(glm::vec3(0.5f)));
    land.at(0, 0) = {kWater, kUnknown, 80, 70};
    EXPECT_GT(land.pixel(paintDay(land.area(4), someColors()), 0, 0, 4).blue, 0);
}

TEST(Paint, TintIsMixedBetweenItsSamples) {
    PaintedColumns land(17, 1);
    const world::PackedColor yellow = world::packColor(200, 190, 60);
    // Samples stand at the columns 0 and 16.
    land.tint() = {-16, -16, 4, 4, std::vector<world::PackedColor>(16, world::kNeutralTint)};
    for (int j = 0; j < 4; ++j) land.tint().samples[static_cast<std::size_t>(4 * j + 2)] = yellow;
    for (int x = -1; x <= 17; ++x) land.at(x, 0) = {kGrass, kGrass, 80, 80};
    const base::Image image = paintDay(land.area(), someColors());
    const glm::vec3 grass(0.4f, 0.6f, 0.3f), neutral = world::tinted(grass, world::kNeutralTint),
                                             tinted = world::tinted(grass, yellow);
    EXPECT_EQ(land.pixel(image, 0, 0), rgbOf(neutral));
    EXPECT_EQ(land.pixel(image, 16, 0), rgbOf(tinted));
    EXPECT_EQ(land.pixel(image, 4, 0), rgbOf(glm::mix(neutral, tinted, 0.25f)));
    EXPECT_NE(rgbOf(neutral), rgbOf(tinted));
}

TEST(Paint, LargeBlocksShowTheirTexels) {
    MapColors colors = someColors();
    for (int k = 0; k < 16; ++k)
        colors[kStone].texels[static_cast<std::size_t>(k)] = glm::vec3(static_cast<float>(k) / 10);
    PaintedColumns land(2, 2);
    const base::Image fine = paintDay(land.area(4), colors);
    ASSERT_EQ(fine.width, 8);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            EXPECT_EQ(land.pixel(fine, 1, 0, 4, x, y),
                      rgbOf(glm::vec3(0.5f) * (static_cast<float>(4 * y + x) / 10)));
    const base::Image coarse = paintDay(land.area(2), colors);
    ASSERT_EQ(coarse.width, 4);
    EXPECT_EQ(land.pixel(coarse, 1, 0, 2, 1, 0), rgbOf(glm::vec3(0.5f) * ((2 + 3 + 6 + 7) / 40.0f)));
    EXPECT_EQ(land.pixel(paintDay(land.area(1), colors), 0, 0), kFlatStone)
        << "the mean, where it is a pixel";
}

TEST(Paint, LampsShineAtNight) {
    PaintedColumns land(40, 40, kLampMargin);
    land.at(20, 20) = {kLamp, kLamp, 80, 80};
    land.at(-4, 5) = {kLamp, kLamp, 80, 80};  // in the margin
    const base::Image image = paintNight(land.area(), someColors());
    const Rgb dark = land.pixel(image, 39, 39);
    EXPECT_LT(dark.red, kFlatStone.red / 3);
    EXPECT_GT(dark.blue, dark.red);
    EXPECT_EQ(land.pixel(image, 20, 20), rgbOf(glm::vec3(0.9f))) << "the lamp itself";
    const Rgb beside = land.pixel(image, 21, 20), farther = land.pixel(image, 27, 20);
    EXPECT_GT(beside.red, farther.red);
    EXPECT_GT(farther.red, dark.red);
    EXPECT_EQ(land.pixel(image, 20, 35), dark) << "15 blocks away, of a lamp that shines 14";
    EXPECT_GT(land.pixel(image, 0, 5).red, 2 * dark.red) << "what is in the margin shines into the image";
    EXPECT_GT(land.pixel(image, 0, 5).red, land.pixel(image, 4, 5).red);
    EXPECT_EQ(land.pixel(image, 0, 22), dark) << "17 blocks away";
    // At higher levels a lamp is seen as well, over fewer columns.
    PaintedColumns far(9, 9, kLampMargin, 6);
    far.at(4, 4) = {kLamp, kLamp, 80, 80};
    const base::Image farImage = paintNight(far.area(), someColors());
    EXPECT_GT(far.pixel(farImage, 5, 4).red, far.pixel(farImage, 8, 4).red);
    EXPECT_EQ(far.pixel(farImage, 7, 4), far.pixel(farImage, 8, 4));
}

// The color is that of the crown; what lies beneath is not visible.
TEST(Paint, ACrownOverWaterIsACrown) {
    MapColors colors = someColors();
    colors[kLamp] = {.mean = {0.2f, 0.5f, 0.1f}, .kind = SurfaceKind::Crown};
    PaintedColumns land(1, 1);
    land.at(0, 0) = {kLamp, kWater, 80, 75};
    EXPECT_EQ(land.pixel(paintDay(land.area(), colors), 0, 0), rgbOf({0.2f, 0.5f, 0.1f}));
}

}  // namespace
}  // namespace terrane::map
