#include "terrane/render/quads/block_textures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "tests/render/content.h"

namespace terrane::render {
namespace {

using base::Image;
using world::AlphaMode;
using Texel = std::array<int, 4>;

constexpr std::array kModes = {AlphaMode::Unused, AlphaMode::Test, AlphaMode::Blend, AlphaMode::Glow,
                               AlphaMode::TestGlow};

template <class TexelAt>
Image makeImage(int size, TexelAt texelAt) {
    Image image{size, size, {}};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            for (const int channel : Texel(texelAt(x, y))) {
                image.rgba.push_back(static_cast<std::uint8_t>(channel));
            }
        }
    }
    return image;
}

Texel texel(const Image& image, int x, int y) {
    const std::size_t at = 4 * static_cast<std::size_t>(x + y * image.width);
    return {image.rgba[at], image.rgba[at + 1], image.rgba[at + 2], image.rgba[at + 3]};
}

float alphaAt(const Image& image, int x, int y) {
    const int last = image.width - 1;
    return static_cast<float>(texel(image, x & last, y & last)[3]) / 255;
}

// The share of the surface that the terrain's shader keeps: alpha is filtered linearly, the texture repeats.
float coverage(const Image& image, AlphaMode mode) {
    constexpr int kSide = 128;  // samples
    const float limit = mode == AlphaMode::TestGlow ? 0.25f : 0.5f;
    const float texels = static_cast<float>(image.width) / kSide;
    int kept = 0;
    for (int k = 0; k < kSide * kSide; ++k) {
        const float u = (static_cast<float>(k % kSide) + 0.5f) * texels - 0.5f;
        const float v = (static_cast<float>(k / kSide) + 0.5f) * texels - 0.5f;
        const int x = static_cast<int>(std::floor(u)), y = static_cast<int>(std::floor(v));
        const float above = std::lerp(alphaAt(image, x, y), alphaAt(image, x + 1, y), u - std::floor(u));
        const float below =
            std::lerp(alphaAt(image, x, y + 1), alphaAt(image, x + 1, y + 1), u - std::floor(u));
        kept += std::lerp(above, below, v - std::floor(v)) >= limit;
    }
    return static_cast<float>(kept) / (kSide * kSide);
}

TEST(Mipmaps, LevelsHalveDownToOneTexel) {
    for (const int size : {1, 2, 16, 64}) {
        const Image image = makeImage(size, [](int x, int y) { return Texel{x, y, 0, 255}; });
        for (const AlphaMode mode : kModes) {
            const std::vector<Image> levels = mipmaps(image, mode);
            EXPECT_EQ(levels[0].rgba, image.rgba) << "level 0 is the image";
            int expected = size;
            for (const Image& level : levels) {
                EXPECT_EQ(level.width, expected);
                EXPECT_EQ(level.height, expected);
                EXPECT_EQ(level.rgba.size(), static_cast<std::size_t>(4 * expected * expected));
                expected /= 2;
            }
            EXPECT_EQ(levels.back().width, 1);
        }
    }
}

TEST(Mipmaps, FlatImagesStayAsTheyAre) {
    for (const AlphaMode mode : kModes) {
        for (const Texel color : {Texel{0, 0, 0, 255},
                                  {255, 255, 255, 255},
                                  {13, 200, 77, 255},
                                  {90, 4, 250, 180},
                                  {9, 9, 9, 0}}) {
            for (const Image& level : mipmaps(makeImage(16, [&](int, int) { return color; }), mode)) {
                EXPECT_EQ(texel(level, 0, 0), color) << "mode " << static_cast<int>(mode);
            }
        }
    }
}

// Half of the light of white is sRGB 188, not 128.
TEST(Mipmaps, ColorsAreAveragedAsLight) {
    const Image image = makeImage(2, [](int x, int) {
        return x ? Texel{255, 255, 255, 255} : Texel{0, 0, 0, 255};
    });
    const Texel mean = texel(mipmaps(image, AlphaMode::Unused)[1], 0, 0);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], 188, 1);
    EXPECT_EQ(mean[3], 255);
}

TEST(Mipmaps, HiddenTexelsGiveNoColor) {
    const Image image = makeImage(2, [](int x, int y) {
        return x == y ? Texel{200, 0, 0, 255} : Texel{0, 250, 0, 0};
    });
    for (const AlphaMode mode : {AlphaMode::Test, AlphaMode::Blend, AlphaMode::TestGlow}) {
        const Texel mean = texel(mipmaps(image, mode)[1], 0, 0);
        EXPECT_EQ(mean[0], 200);
        EXPECT_EQ(mean[1], 0);
    }
    EXPECT_NEAR(texel(mipmaps(image, AlphaMode::Blend)[1], 0, 0)[3], 128, 1);
    EXPECT_GT(texel(mipmaps(image, AlphaMode::Glow)[1], 0, 0)[1], 100) << "alpha is no coverage here";
}

// Whatever color a painter left under a hole, filters near its edge must not show it.
TEST(Mipmaps, HiddenTexelsTakeTheColorBesideThem) {
    const Image stem = makeImage(16, [](int x, int y) {
        if (x != 8) return Texel{255, 0, 255, 0};
        return y < 4 ? Texel{200, 200, 200, 255} : Texel{10, 120, 20, 255};
    });
    for (const AlphaMode mode : {AlphaMode::Test, AlphaMode::TestGlow}) {
        const Image filled = mipmaps(stem, mode)[0];
        for (const int x : {0, 5, 7, 9, 15}) EXPECT_EQ(texel(filled, x, 9), (Texel{10, 120, 20, 0})) << x;
        EXPECT_EQ(texel(filled, 7, 2), (Texel{200, 200, 200, 0}));
        EXPECT_EQ(texel(filled, 8, 9), texel(stem, 8, 9));
    }
    EXPECT_EQ(mipmaps(stem, AlphaMode::Glow)[0].rgba, stem.rgba) << "alpha says something else";
}

TEST(Mipmaps, WhereAllIsHiddenColorsStayForFilters) {
    const Image image = makeImage(4, [](int, int) { return Texel{40, 90, 10, 0}; });
    const Texel mean = texel(mipmaps(image, AlphaMode::Test)[2], 0, 0);
    EXPECT_EQ(mean, (Texel{40, 90, 10, 0}));
}

// One texel is there or not, and of four there is little to choose from.
float coverageTolerance(const Image& level) {
    return level.width <= 2 ? 0.5f : 0.04f;
}

void expectCoverageKept(const Image& image, AlphaMode mode) {
    const float wanted = coverage(image, mode);
    for (const Image& level : mipmaps(image, mode)) {
        EXPECT_NEAR(coverage(level, mode), wanted, coverageTolerance(level)) << level.width << " wide";
    }
}

TEST(Mipmaps, CoverageOfScatteredHolesIsKept) {
    std::mt19937 random(5);
    for (const AlphaMode mode : {AlphaMode::Test, AlphaMode::TestGlow}) {
        for (const float share : {0.05f, 0.2f, 0.35f, 0.5f, 0.7f, 0.9f}) {
            SCOPED_TRACE(share);
            std::bernoulli_distribution isSolid(share);
            expectCoverageKept(makeImage(32,
                                         [&](int, int) {
                                             return Texel{60, 120, 30, isSolid(random) ? 255 : 0};
                                         }),
                               mode);
        }
    }
}

TEST(Mipmaps, CoverageOfTheContentIsKept) {
    for (const std::string name : {"oak_leaves", "grass_tuft", "blue_orchid", "poppy", "oxeye_daisy",
                                   "red_mushroom", "brown_mushroom", "cactus_side"}) {
        SCOPED_TRACE(name);
        const auto image = contentTexture(name);
        ASSERT_TRUE(image) << image.error().message;
        expectCoverageKept(*image, AlphaMode::Test);
    }
}

TEST(Mipmaps, AlphaOfOtherTexturesIsAveraged) {
    const Image image = makeImage(2, [](int x, int y) { return Texel{1, 2, 3, 10 * (x + 2 * y)}; });
    EXPECT_EQ(texel(mipmaps(image, AlphaMode::Glow)[1], 0, 0)[3], 15);
    EXPECT_EQ(texel(mipmaps(image, AlphaMode::Blend)[1], 0, 0)[3], 15);
}

TEST(Mipmaps, RowsAndColumnsKeepTheirPlaces) {
    const Image image = makeImage(4, [](int x, int y) {
        return Texel{x < 2 ? 255 : 0, y < 2 ? 255 : 0, 0, 255};
    });
    const Image half = mipmaps(image, AlphaMode::Unused)[1];
    EXPECT_EQ(texel(half, 0, 0), (Texel{255, 255, 0, 255}));
    EXPECT_EQ(texel(half, 1, 0), (Texel{0, 255, 0, 255}));
    EXPECT_EQ(texel(half, 0, 1), (Texel{255, 0, 0, 255}));
}

// A red column, and a blue one at the right border: the left border is next to the blue one where the texture
// repeats.
TEST(Mipmaps, HiddenTexelsTakeColorsAcrossTheBorderUnlessItIsClamped) {
    const Image image = makeImage(8, [](int x, int) {
        if (x == 3) return Texel{255, 0, 0, 255};
        return x == 7 ? Texel{0, 0, 255, 255} : Texel{0, 0, 0, 0};
    });
    const Image repeated = mipmaps(image, AlphaMode::Test)[0];
    const Image clamped = mipmaps(image, AlphaMode::Test, world::Wrap::Clamp)[0];
    EXPECT_EQ(texel(repeated, 0, 3), (Texel{0, 0, 255, 0})) << "from the last column, beside the first";
    EXPECT_EQ(texel(clamped, 0, 3), (Texel{255, 0, 0, 0}));
    EXPECT_EQ(texel(clamped, 6, 3), (Texel{0, 0, 255, 0}));
}

}  // namespace
}  // namespace terrane::render
