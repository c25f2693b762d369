#include "apps/terrane/window/game/pictures.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

base::Image striped(int width, int height) {
    base::Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int value : {x % 2 * 200, 100, y % 2 * 100, 255})
                image.rgba.push_back(static_cast<std::uint8_t>(value));
    return image;
}

TEST(Thumbnail, IsTheMeanOfWhatItCovers) {
    const base::Image small = thumbnailFrom(striped(1280, 720));
    EXPECT_EQ(small.width, 320);
    EXPECT_EQ(small.height, 180);
    ASSERT_EQ(small.rgba.size(), 4u * 320 * 180);
    EXPECT_EQ(small.rgba[0], 100);
    EXPECT_EQ(small.rgba[1], 100);
    EXPECT_EQ(small.rgba[2], 50);
    EXPECT_EQ(small.rgba[3], 255);
}

TEST(Thumbnail, OddSizesKeepTheirMiddle) {
    for (const auto& [width, height] :
         {std::pair(1, 1), {7, 3}, {101, 77}, {200, 400}, {3000, 100}, {4096, 4096}}) {
        const base::Image small = thumbnailFrom(striped(width, height));
        EXPECT_GT(small.width, 0);
        EXPECT_LE(small.width, std::min(width, kThumbnailWidth));
        EXPECT_LE(small.height, std::min(height, kThumbnailHeight));
        EXPECT_EQ(small.rgba.size(), 4u * static_cast<std::size_t>(small.width * small.height));
        EXPECT_EQ(small.rgba.back(), 255);
    }
    EXPECT_TRUE(thumbnailFrom({}).rgba.empty());
}

}  // namespace
}  // namespace terrane::app
