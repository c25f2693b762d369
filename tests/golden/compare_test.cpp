// Tests the comparison on synthetic images.
#include "tests/golden/compare.h"

#include "tests/base/temp_folder.h"
#include "tests/golden/golden.h"

namespace terrane::golden {
namespace {

// An image with shapes and shades everywhere.
base::Image patterned(int width, int height) {
    base::Image image{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (const int channel : {x * 5, y * 7, 100 + (x / 8 + y / 8) % 2 * 60, 255}) {
                image.rgba.push_back(static_cast<std::uint8_t>(std::min(channel, 255)));
            }
        }
    }
    return image;
}

// Adds `by` to one channel in a square.
base::Image brightened(base::Image image, int x0, int y0, int size, int by) {
    for (int y = y0; y < y0 + size; ++y) {
        for (int x = x0; x < x0 + size; ++x) {
            std::uint8_t& channel = image.rgba[static_cast<std::size_t>(4 * (x + y * image.width) + 1)];
            channel = static_cast<std::uint8_t>(std::clamp(channel + by, 0, 255));
        }
    }
    return image;
}

TEST(Compare, EqualImagesDoNotDiffer) {
    const base::Image image = patterned(40, 30);
    const Difference d = difference(image, image);
    EXPECT_EQ(d.max, 0);
    EXPECT_EQ(d.mean, 0);
    EXPECT_TRUE(isSame(image, image));
}

TEST(Compare, OnePixelIsForgivenATileIsNot) {
    const base::Image image = patterned(40, 30);
    EXPECT_TRUE(isSame(image, brightened(image, 10, 10, 1, 100)));
    EXPECT_FALSE(isSame(image, brightened(image, 12, 12, 4, 40)));
    EXPECT_NEAR(difference(image, brightened(image, 12, 12, 4, 40)).max, 40, 1e-9);
}

TEST(Compare, ASlightChangeEverywhereIsNotForgiven) {
    base::Image image = patterned(40, 30);
    const base::Image before = image;
    for (std::size_t k = 2; k < image.rgba.size(); k += 4)
        image.rgba[k] = static_cast<std::uint8_t>(image.rgba[k] + 1);
    EXPECT_NEAR(difference(before, image).mean, 1, 1e-9);
    EXPECT_FALSE(isSame(before, image));
}

TEST(Compare, MeansAreOfTheWorstChannel) {
    const base::Image image = patterned(10, 10);
    EXPECT_NEAR(difference(image, brightened(image, 0, 0, 5, 8)).mean, 8.0 * 25 / 100, 1e-9);
}

TEST(Compare, SmallTilesAtTheBorderCount) {
    const base::Image image = patterned(13, 9);
    EXPECT_NEAR(difference(image, brightened(image, 12, 8, 1, 50)).max, 50, 1e-9);
}

TEST(Compare, OtherSizesDiffer) {
    EXPECT_FALSE(isSame(patterned(40, 30), patterned(30, 40)));
}

TEST(Compare, FlatImagesAreFound) {
    base::Image flat{16, 16, std::vector<std::uint8_t>(16 * 16 * 4, 77)};
    EXPECT_TRUE(isFlat(flat));
    flat.rgba[400] = 80;
    EXPECT_TRUE(isFlat(flat)) << "noise is no image";
    EXPECT_FALSE(isFlat(patterned(16, 16)));
    EXPECT_FALSE(isFlat(brightened(flat, 3, 3, 5, 60)));
}

class MatchesGolden : public testing::Test {
  protected:
    testing::AssertionResult match(const base::Image& image, bool update = false) const {
        return matchesGolden("image", image, update, {folder_.path(), folder_.path() / "failures"});
    }
    bool exists(const char* name) const {
        return std::filesystem::exists(folder_.path() / "failures" / name);
    }

    const base::TempFolder folder_;
};

TEST_F(MatchesGolden, AMissingGoldenFails) {
    const auto result = match(patterned(40, 30));
    EXPECT_FALSE(result);
    EXPECT_NE(std::string(result.message()).find("TERRANE_UPDATE_GOLDEN=1"), std::string::npos);
    EXPECT_TRUE(exists("image.actual.png"));
}

TEST_F(MatchesGolden, AnUpdateWritesWhatIsComparedAfterwards) {
    EXPECT_TRUE(match(patterned(40, 30), true));
    EXPECT_TRUE(match(patterned(40, 30)));
    EXPECT_FALSE(match(brightened(patterned(40, 30), 8, 8, 8, 60)));
    EXPECT_TRUE(exists("image.actual.png"));
    EXPECT_TRUE(exists("image.difference.png"));
}

TEST_F(MatchesGolden, AnotherSizeFails) {
    ASSERT_TRUE(match(patterned(40, 30), true));
    EXPECT_FALSE(match(patterned(40, 31)));
}

TEST_F(MatchesGolden, AMissingOrFlatRenderFailsAlsoAsUpdate) {
    const base::Image flat{16, 16, std::vector<std::uint8_t>(16 * 16 * 4, 77)};
    for (const bool update : {false, true}) {
        EXPECT_FALSE(match(base::Image{}, update));
        EXPECT_FALSE(match(flat, update));
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "image.png"));
}

}  // namespace
}  // namespace terrane::golden
