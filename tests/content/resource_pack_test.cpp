#include "terrane/content/resource_pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "terrane/content/built_in.h"
#include "terrane/world/blocks/block_description.h"
#include "tests/base/temp_folder.h"

namespace terrane::content {
namespace {

using testing::HasSubstr;

class ResourcePack : public testing::Test {
  protected:
    // Left half of one color, right half of another.
    static base::Image halves(int side) {
        base::Image image{side, side, {}};
        for (int k = 0; k < side * side; ++k) {
            const std::uint8_t red = k % side < side / 2 ? 200 : 100;
            image.rgba.insert(image.rgba.end(), {red, 20, 30, 255});
        }
        return image;
    }
    void add(const char* file, const base::Image& image) {
        ASSERT_TRUE(base::writePng(folder_.path() / file, image));
    }
    base::Result<world::TextureSource> load() const { return loadTextures(folder_.path().string(), blocks_); }
    std::string error() const {
        const auto loaded = load();
        return loaded ? "" : loaded.error().message;
    }
    base::Image texture(std::string_view name) const { return load().value()(name).value(); }

    base::TempFolder folder_;
    world::BlockRegistry blocks_ = loadBlocks().value();
};

TEST_F(ResourcePack, WhatItLacksIsBuiltIn) {
    add("stone.png", halves(16));
    EXPECT_EQ(texture("stone").rgba, halves(16).rgba);
    EXPECT_EQ(texture("dirt").rgba, builtInTextures()("dirt").value().rgba);
}

TEST_F(ResourcePack, TexturesKeepTheirSizes) {
    add("stone.png", halves(64));
    add("sand.png", halves(2));
    EXPECT_EQ(texture("stone").rgba, halves(64).rgba);
    EXPECT_EQ(texture("sand").rgba, halves(2).rgba);
    EXPECT_EQ(texture("dirt").rgba, builtInTextures()("dirt").value().rgba);
}

// Textures of a content pack are in a folder of its name.
TEST_F(ResourcePack, AFolderHoldsTheTexturesOfAContentPack) {
    const auto blocks = world::BlockRegistry::fromDescriptions(
        [] {
            world::BlockDescription glow;
            glow.type.name = "isles:glow";
            glow.faces.fill({.texture = "isles:glow"});
            return std::vector{glow};
        }(),
        "blocks");
    std::filesystem::create_directories(folder_.path() / "isles");
    add("isles/glow.png", halves(16));
    const auto textures = loadTextures(folder_.path().string(), blocks.value());
    ASSERT_TRUE(textures) << textures.error().message;
    EXPECT_EQ((*textures)("isles:glow").value().rgba, halves(16).rgba);
}

TEST_F(ResourcePack, FilesThatCannotBeUsedAreNamed) {
    add("stone.png", halves(24));
    EXPECT_THAT(error(), HasSubstr("stone.png: 24 × 24 pixels; a texture is square"));
    base::Image strip = halves(16);
    strip.height = 4;
    strip.rgba.resize(std::size_t{16} * 4 * 4);
    add("stone.png", strip);
    EXPECT_THAT(error(), HasSubstr("stone.png: 16 × 4 pixels"));
    add("stone.png", halves(2048));
    EXPECT_THAT(error(), HasSubstr("2048 × 2048 pixels are more than the 1048576 allowed"));
    std::ofstream(folder_.path() / "stone.png") << "no image";
    EXPECT_THAT(error(), HasSubstr("stone.png: cannot be read as PNG"));
}

TEST_F(ResourcePack, EachBadFileHasALine) {
    add("dirt.png", halves(3));
    add("stone.png", halves(5));
    testing::internal::CaptureStderr();
    EXPECT_THAT(error(), HasSubstr("stone.png: 5 × 5"));
    const std::string lines = testing::internal::GetCapturedStderr();
    EXPECT_THAT(lines, HasSubstr("error: "));
    EXPECT_THAT(lines, HasSubstr("dirt.png: 3 × 3"));
}

TEST_F(ResourcePack, NamesOfNoTextureAreWarnedOf) {
    add("stonee.png", halves(16));
    std::ofstream(folder_.path() / "readme.txt") << "text";
    testing::internal::CaptureStderr();
    EXPECT_EQ(texture("stone").rgba, builtInTextures()("stone").value().rgba);
    const std::string lines = testing::internal::GetCapturedStderr();
    EXPECT_THAT(lines, HasSubstr("warning: "));
    EXPECT_THAT(lines, HasSubstr("stonee.png: not used, since no texture has this name"));
    EXPECT_THAT(lines, Not(HasSubstr("readme")));
}

TEST_F(ResourcePack, AFolderThatIsNotThereIsNamed) {
    const auto loaded = loadTextures((folder_.path() / "none").string(), blocks_);
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().message, HasSubstr("none: cannot be read as a resource pack"));
}

TEST_F(ResourcePack, NoFolderIsNoPack) {
    const auto loaded = loadTextures("", blocks_);
    ASSERT_TRUE(loaded);
    EXPECT_EQ((*loaded)("stone").value().rgba, builtInTextures()("stone").value().rgba);
}

}  // namespace
}  // namespace terrane::content
