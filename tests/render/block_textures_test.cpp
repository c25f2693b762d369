#include "terrane/render/quads/block_textures.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "terrane/shared/material.h"

namespace terrane::render {
namespace {

using world::AlphaMode;

world::BlockRegistry textureRegistry(const std::string& toml) {
    auto parsed = world::BlockRegistry::parse(toml, "blocks.toml");
    EXPECT_TRUE(parsed) << (parsed ? "" : parsed.error().message);
    return parsed ? *std::move(parsed) : world::BlockRegistry();
}

// A block for each meaning of alpha, all with one texture.
world::BlockRegistry withMeanings(std::initializer_list<std::string_view> meanings) {
    std::string toml;
    for (const std::string_view alpha : meanings) {
        toml += fmt::format(
            "[[block]]\nname = \"b{}\"\nshape = \"cube\"\ntexture = \"shared\"\nalpha = \"{}\"\nopacity = "
            "0\n",
            toml.size(), alpha);
    }
    return textureRegistry(toml);
}

TEST(BlockTextures, OfSeveralMeaningsOfAlphaOneThatTestsCounts) {
    struct Case {
        std::initializer_list<std::string_view> meanings;
        AlphaMode expected;
    };
    const Case cases[] = {
        {{"unused"}, AlphaMode::Unused},
        {{"test"}, AlphaMode::Test},
        {{"test", "blend"}, AlphaMode::Test},
        {{"blend", "test"}, AlphaMode::Test},
        {{"glow", "test_glow", "blend", "unused"}, AlphaMode::TestGlow},
        {{"test_glow", "test"}, AlphaMode::TestGlow},
        {{"blend", "glow", "unused"}, AlphaMode::Glow},
    };
    for (const Case& c : cases) {
        const world::BlockRegistry registry = withMeanings(c.meanings);
        ASSERT_EQ(registry.textures()[0], "shared");
        EXPECT_EQ(textureAlpha(registry, 0), c.expected) << "case " << &c - cases;
    }
}

TEST(BlockTextures, ASmallTextureHasItsOwnMipmapsBehindEnlargedOnes) {
    const base::Image small{2, 2, {10, 20, 30, 255, 40, 50, 60, 255, 70, 80, 90, 255, 1, 2, 3, 255}};
    const auto own = mipmaps(small, AlphaMode::Unused);
    const auto levels = levelsInArray(own, 8);
    ASSERT_EQ(levels.size(), 4u);
    for (std::size_t level = 0; level < 2; ++level) {
        const int side = 8 >> level;
        ASSERT_EQ(levels[level].width, side);
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const auto at = static_cast<std::size_t>(4 * (y * side + x));
                const auto from = static_cast<std::size_t>(4 * (2 * y / side * 2 + 2 * x / side));
                ASSERT_EQ(levels[level].rgba[at], small.rgba[from]) << level << ' ' << x << ' ' << y;
            }
        }
    }
    EXPECT_EQ(levels[2].rgba, own[0].rgba);
    EXPECT_EQ(levels[3].rgba, own[1].rgba);
}

TEST(BlockTextures, ATextureIsClampedWhereOneFaceClampsIt) {
    const world::BlockRegistry registry = textureRegistry(
        "[[block]]\nname = \"a\"\nshape = \"cube\"\ntextures = { top = \"t\", bottom = \"b\", side = \"t\" "
        "}\n"
        "wrap = { side = \"clamp\", bottom = \"repeat\" }\n");
    const auto wrapOf = [&](std::string_view name) {
        const auto names = registry.textures();
        return textureWrap(registry,
                           static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
    };
    EXPECT_EQ(wrapOf("t"), world::Wrap::Clamp);
    EXPECT_EQ(wrapOf("b"), world::Wrap::Quad);
}

base::Result<base::Image> textureNobodyReads(std::string_view name) {
    ADD_FAILURE() << name << " was read";
    return base::fail("not to be read");
}

// Fails before an image is read, with a message that has the number.
TEST(BlockTextures, MoreThanCanBeDrawnAreAnError) {
    std::string toml;
    for (shared::uint k = 0; k < shared::kMaxBlockTextures; ++k) {
        toml += fmt::format("[[block]]\nname = \"b{0}\"\nshape = \"cube\"\ntexture = \"t{0}\"\n", k);
    }
    const world::BlockRegistry registry = textureRegistry(toml);
    ASSERT_EQ(registry.textures().size(), 4097u) << "those and the one of the missing block";
    const auto byWord = loadBlockTextures(registry, textureNobodyReads, {.layers = 1 << 20});
    ASSERT_FALSE(byWord);
    EXPECT_EQ(byWord.error().message, "the blocks have 4097 textures: at most 4096 can be drawn");
    const auto byDriver = loadBlockTextures(registry, textureNobodyReads, {.layers = 2048});
    ASSERT_FALSE(byDriver);
    EXPECT_EQ(byDriver.error().message, "the blocks have 4097 textures: at most 2048 can be drawn");
}

}  // namespace
}  // namespace terrane::render
