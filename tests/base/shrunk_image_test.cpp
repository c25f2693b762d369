#include "terrane/base/shrunk_image.h"

#include <gtest/gtest.h>

namespace terrane::base {
namespace {

Image stripes(int width, int height) {
    Image image{.width = width, .height = height, .rgba = {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int c : {x % 2 == 0 ? 0 : 200, y, 7, 255})
                image.rgba.push_back(static_cast<std::uint8_t>(c));
    return image;
}

TEST(ShrunkImage, KeepsTheShape) {
    const Image small = shrunk(stripes(160, 90), 32, 100);
    EXPECT_EQ(small.width, 32);
    EXPECT_EQ(small.height, 18);
    EXPECT_EQ(small.rgba.size(), 32u * 18 * 4);
    EXPECT_EQ(shrunk(stripes(400, 1), 10, 10).height, 1);
}

TEST(ShrunkImage, EachPixelIsAMean) {
    const Image small = shrunk(stripes(8, 8), 2, 2);
    EXPECT_EQ(small.rgba[0], 100) << "of black and bright columns";
    EXPECT_EQ(small.rgba[1], 2) << "of rows 0 to 3, 1.5";
    EXPECT_EQ(small.rgba[2], 7);
    EXPECT_EQ(small.rgba[3], 255);
}

TEST(ShrunkImage, WhatFitsStaysAsItIs) {
    const Image image = stripes(5, 3);
    EXPECT_EQ(shrunk(image, 5, 3).rgba, image.rgba);
    EXPECT_EQ(shrunk(image, 50, 30).rgba, image.rgba);
}

}  // namespace
}  // namespace terrane::base
