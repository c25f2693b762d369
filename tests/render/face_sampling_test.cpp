// Keys of faces in images: textures of different sizes, wrapping, filtering, surfaces of liquids.
#include <cmath>
#include <set>

#include "terrane/mesh/chunk_mesher.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

constexpr std::string_view kNames[] = {"sand",        "grass", "oak_leaves",       "poppy",      "wheat",
                                       "cactus",      "water", "cyan_glass",       "oak_log",    "lamp_red",
                                       "glowing_ore", "dirt",  "glowing_mushroom", "grass_tuft", "snow"};

// Ground of sand with rows of blocks on it, from before the camera to 130 blocks away.
void addScene(Renderer& renderer, const world::BlockRegistry& blocks) {
    for (int chunkX = 0; chunkX < 8; ++chunkX) {
        world::Chunk chunk;
        for (int y = 0; y < world::kChunkSize; ++y) {
            for (int x = 0; x < world::kChunkSize; ++x) {
                chunk.setBlock(world::blockIndex(x, y, 97), blocks.find("sand")->id);
                const auto pick = static_cast<std::size_t>(3 * x + 5 * y + chunkX) % std::size(kNames);
                if ((x + 2 * y) % 3 == 0)
                    chunk.setBlock(world::blockIndex(x, y, 98), blocks.find(kNames[pick])->id);
            }
        }
        ASSERT_TRUE(renderer.setChunk({chunkX, 0}, mesh::meshAlone(chunk, blocks)));
    }
}

// The built-in textures, except that of stone, which no block of the scene has: 64² of all colors.
base::Result<base::Image> withLargeStone(std::string_view name) {
    if (name != "stone") return contentTexture(name);
    base::Image image{64, 64, {}};
    for (int k = 0; k < 64 * 64; ++k) {
        const auto byte = [&](int times) { return static_cast<std::uint8_t>(k * times); };
        image.rgba.insert(image.rgba.end(), {byte(7), byte(31), byte(101), 255});
    }
    return image;
}

int maxDifference(const base::Image& a, const base::Image& b) {
    int most = 0;
    for (std::size_t k = 0; k < a.rgba.size(); ++k)
        most = std::max(most, std::abs(int{a.rgba[k]} - int{b.rgba[k]}));
    return most;
}

int differentPixels(const base::Image& a, const base::Image& b) {
    int count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) count += pixel(a, x, y) != pixel(b, x, y) ? 1 : 0;
    return count;
}

class FaceSampling : public RendererTest {
  protected:
    static Renderer make(const world::BlockRegistry& blocks, const TextureSource& textures) {
        gpu::DeviceInfo device = gpu::queryDevice();
        device.software = true;  // no anisotropic filter: drivers may filter as they like
        auto made = Renderer::create(contentShaders(), blocks, textures, device);
        if (!made) throw std::runtime_error(made.error().message);
        addScene(*made, blocks);
        return std::move(*made);
    }
    static base::Image draw(Renderer& renderer, const Camera& camera, int samples, bool isSharp) {
        RenderOptions options = plainOptions(samples);
        options.sharpFiltering = isSharp;
        options.msaaAlphaTest = samples > 1;
        EXPECT_TRUE(renderer.configure({160, 96}, options));
        renderer.draw(noon(camera));
        return renderer.readImage();
    }
    // The block types of the program, each with these lines.
    static world::BlockRegistry contentWith(std::string_view lines) {
        std::string text = *base::readFile(TERRANE_SOURCE_DIR "/assets/blocks.toml");
        const std::string head = "\n[[block]]\n";
        for (std::size_t at = text.find(head); at != std::string::npos; at = text.find(head, at + 1))
            text.insert(at + head.size(), lines);
        return world::BlockRegistry::parse(text, "blocks.toml").value();
    }
};

const Camera kCameras[] = {{{-1.5, 7.3, 99.6}, 4, -20},  // magnified and minified
                           {{5.3, 5.2, 98.9}, 40, -35},  // some texels cover 30 pixels
                           {{-1, 8, 112}, 0, -25, 25}};  // all minified

TEST_F(FaceSampling, ALargerTextureLeavesOtherBlocksAsTheyAre) {
    Renderer plain = make(contentBlocks(), contentTexture), mixed = make(contentBlocks(), withLargeStone);
    for (const Camera& camera : kCameras) {
        for (const int samples : {1, 4}) {
            for (const bool isSharp : {false, true}) {
                const base::Image expected = draw(plain, camera, samples, isSharp);
                EXPECT_EQ(maxDifference(draw(mixed, camera, samples, isSharp), expected), 0)
                    << &camera - kCameras << ", samples " << samples << (isSharp ? ", sharp" : "");
            }
        }
    }
}

TEST_F(FaceSampling, ALargerTextureThatComesLaterIsDrawnAsFromTheBeginning) {
    Renderer renderer = make(contentBlocks(), contentTexture), mixed = make(contentBlocks(), withLargeStone);
    const base::Image before = draw(renderer, kCameras[0], 1, true);
    for (Renderer* each : {&renderer, &mixed}) {
        world::Chunk chunk;
        for (int y = 0; y < 16; ++y) chunk.setBlock(world::blockIndex(3, y, 98), contentBlock("stone"));
        ASSERT_TRUE(each->setChunk({0, 0}, mesh::meshAlone(chunk, contentBlocks())));
    }
    ASSERT_TRUE(renderer.setTextures(contentBlocks(), withLargeStone));
    const base::Image expected = draw(mixed, kCameras[0], 1, true);
    EXPECT_EQ(maxDifference(draw(renderer, kCameras[0], 1, true), expected), 0);
    EXPECT_GT(maxDifference(before, expected), 30);
    ASSERT_TRUE(renderer.setTextures(contentBlocks(), contentTexture));
    addScene(renderer, contentBlocks());
    EXPECT_EQ(maxDifference(draw(renderer, kCameras[0], 1, true), before), 0) << "and as before again";
}

// Up to one pixel in 200 may differ: the driver chooses the mipmap of a nearest texel by derivatives of its
// own or by given ones.
TEST_F(FaceSampling, TheKeySharpIsTheOptionOfAFace) {
    Renderer plain = make(contentBlocks(), contentTexture);
    for (const bool isSharp : {false, true}) {
        const world::BlockRegistry blocks = contentWith(isSharp ? "sharp = true\n" : "sharp = false\n");
        Renderer keyed = make(blocks, contentTexture);
        for (const Camera& camera : kCameras) {
            const base::Image expected = draw(plain, camera, 1, isSharp);
            const base::Image drawn = draw(keyed, camera, 1, !isSharp);
            EXPECT_LE(differentPixels(drawn, expected), isSharp ? 0 : 160 * 96 / 200);
            EXPECT_GT(differentPixels(draw(plain, camera, 1, !isSharp), expected), 1000);
        }
    }
}

// A texture with a red left column and a blue right one, on a wall of blocks. Far away a filter that reaches
// around the border mixes both.
base::Result<base::Image> redToBlue(std::string_view) {
    base::Image image{16, 16, {}};
    for (int k = 0; k < 256; ++k) {
        const bool isRed = k % 16 < 8;
        image.rgba.insert(image.rgba.end(),
                          {std::uint8_t(isRed ? 255 : 0), 0, std::uint8_t(isRed ? 0 : 255), 255});
    }
    return image;
}

class WrapOfFaces : public FaceSampling {
  protected:
    // Pixels of a wall of `count` blocks whose color is neither red nor blue but between, by columns.
    static std::set<int> mixedColumns(std::string_view wrap, int count) {
        const auto blocks = world::BlockRegistry::parse(
            fmt::format("[[block]]\nname = \"wall\"\nshape = \"cube\"\ntexture = \"a\"\nwrap = \"{}\"\n",
                        wrap),
            "blocks.toml");
        EXPECT_TRUE(blocks);
        gpu::DeviceInfo device = gpu::queryDevice();
        device.software = true;
        auto renderer = Renderer::create(contentShaders(), *blocks, redToBlue, device);
        world::Chunk chunk;
        for (int y = 0; y < count; ++y) chunk.setBlock(world::blockIndex(4, 7 - y, 100), 1);
        renderer->setChunk({0, 0}, mesh::meshAlone(chunk, *blocks));
        RenderOptions options = plainOptions(1);
        options.shading = Shading::Off;
        EXPECT_TRUE(renderer->configure({96, 32}, options));
        // 4 pixels a block.
        renderer->draw({{{-10.37, 7.03, 100.5}, 0, 0, 32}, world::environmentAt(0.5f), 4000, 0, View::Color});
        const base::Image image = renderer->readImage();
        std::set<int> columns;
        for (int x = 0; x < image.width; ++x) {
            const Color color = pixel(image, x, 16);
            if (color[1] < 40 && color[0] > 15 && color[2] > 15) columns.insert(x);
        }
        return columns;
    }
};

TEST_F(WrapOfFaces, ClampedTexturesDoNotBleedOverTheirBorder) {
    const auto count = [](std::string_view wrap, int blocks) { return mixedColumns(wrap, blocks).size(); };
    // A single block: its middle alone is mixed, with filters around the border its edges too.
    EXPECT_EQ(mixedColumns("clamp", 1), mixedColumns("quad", 1));
    EXPECT_GT(count("repeat", 1), count("quad", 1));
    // A merged quad: also where blocks meet, unless each is clamped.
    EXPECT_GT(count("quad", 6), count("clamp", 6));
    EXPECT_GT(count("repeat", 6), count("quad", 6));
}

base::Result<base::Image> onlyRed(std::string_view) {
    return base::Image{1, 1, {255, 0, 0, 255}};
}

TEST_F(FaceSampling, SurfacesOfLiquidsLieAsHighAsTheirKeySays) {
    const auto rowsOfLiquid = [](std::string_view lines) {
        const auto blocks = world::BlockRegistry::parse(
            fmt::format(
                "[[block]]\nname = \"oil\"\nshape = \"liquid\"\ntexture = \"oil\"\nalpha = \"blend\"\n"
                "opacity = 1\n{}\n",
                lines),
            "blocks.toml");
        EXPECT_TRUE(blocks) << (blocks ? "" : blocks.error().message);
        auto renderer = Renderer::create(contentShaders(), *blocks, onlyRed, gpu::queryDevice());
        world::Chunk chunk;
        for (int y = 0; y < 16; ++y) chunk.setBlock(world::blockIndex(4, y, 100), 1);
        renderer->setChunk({0, 0}, mesh::meshAlone(chunk, *blocks));
        EXPECT_TRUE(renderer->configure({32, 128}, plainOptions(1)));
        // From the height of the block's bottom, 2 blocks away: 128 rows are 2 blocks.
        renderer->draw({{{2, 8, 100}, 0, 0, 53.13f}, world::environmentAt(0.5f), 4000, 0, View::Color});
        const base::Image image = renderer->readImage();
        int rows = 0;
        for (int y = 0; y < image.height; ++y) {
            const Color color = pixel(image, 16, y);
            rows += color[0] > color[2] + 30 ? 1 : 0;
        }
        return rows;
    };
    EXPECT_NEAR(rowsOfLiquid(""), 56, 1) << "14/16";
    EXPECT_NEAR(rowsOfLiquid("surface_height = 0.5"), 32, 1);
    EXPECT_NEAR(rowsOfLiquid("surface_height = 0.25"), 16, 1);
    EXPECT_NEAR(rowsOfLiquid("surface_height = 1"), 64, 1);
}

TEST_F(FaceSampling, WavesOfLiquidsAreAsHighAsTheirKeySays) {
    const auto imageWith = [&](std::string_view waves, float seconds) {
        std::string text = *base::readFile(TERRANE_SOURCE_DIR "/assets/blocks.toml");
        const std::string animated = "animation = \"liquid_surface\"\n";
        text.insert(text.find(animated) + animated.size(), waves);
        const world::BlockRegistry blocks = world::BlockRegistry::parse(text, "blocks.toml").value();
        auto renderer = Renderer::create(contentShaders(), blocks, contentTexture, gpu::queryDevice());
        world::Chunk chunk;
        for (int x = 0; x < 16; ++x)
            for (int y = 0; y < 16; ++y)
                chunk.setBlock(world::blockIndex(x, y, 100), blocks.find("water")->id);
        renderer->setChunk({0, 0}, mesh::meshAlone(chunk, blocks));
        RenderOptions options = plainOptions(1);
        options.animation = true;
        EXPECT_TRUE(renderer->configure(kImageSize, options));
        FrameInput input = noon({{-3, 8, 101.5}, 0, -10}, View::Color);
        input.timeSeconds = seconds;
        renderer->draw(input);
        return renderer->readImage();
    };
    const auto change = [&](std::string_view waves) {
        return differentPixels(imageWith(waves, 0.3f), imageWith(waves, 1.9f));
    };
    EXPECT_EQ(imageWith("wave_height = 0.06\n", 0.3f).rgba, imageWith("", 0.3f).rgba) << "the default";
    EXPECT_NE(imageWith("wave_height = 0.25\n", 0.3f).rgba, imageWith("", 0.3f).rgba);
    EXPECT_GT(change("wave_height = 0.25\n"), 0);
}

}  // namespace
}  // namespace terrane::render
