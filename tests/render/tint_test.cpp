// Images with a tint.
#include <algorithm>
#include <cmath>

#include "terrane/mesh/chunk_mesher.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

// A floor of one block at z = 100 over the whole chunk, of a level.
mesh::ChunkMesh floorOf(std::string_view name) {
    world::Chunk chunk;
    for (int k = 0; k < 256; ++k) chunk.setBlock(world::blockIndex(k % 16, k / 16, 100), contentBlock(name));
    return mesh::meshAlone(chunk, contentBlocks());
}

using Mean = std::array<double, 3>;

Mean meanOf(const base::Image& image) {
    Mean mean{};
    for (std::size_t k = 0; k < image.rgba.size(); ++k)
        if (k % 4 < 3) mean[k % 4] += image.rgba[k] * 4.0 / static_cast<double>(image.rgba.size());
    return mean;
}

const Camera kFromAbove{.position = {8, 8, 106}, .yaw = 0, .pitch = -89, .fieldOfView = 60};

class TintImages : public RendererTest {
  protected:
    // Colors as they are: no light, no air.
    void SetUp() override {
        RendererTest::SetUp();
        if (IsSkipped()) return;
        RenderOptions options = plainOptions(1);
        options.shading = Shading::Off;
        options.distanceFog = false;
        ASSERT_TRUE(renderer_->configure(kImageSize, options));
    }
    base::Image imageOf(std::string_view block) {
        renderer_->clearChunks();
        renderer_->setChunk({0, 0}, floorOf(block));
        return draw(noon(kFromAbove));
    }
    void tintAll(world::PackedColor color) {
        EXPECT_TRUE(renderer_->useTint(true));  // forgets those before
        world::TintTile tile;
        tile.fill(color);
        for (const world::ChunkPos pos : renderer_->tintClipmap().missing({0, 0}, 1e6, SIZE_MAX))
            renderer_->setTint(pos, tile);
    }
};

// A neutral or missing tint changes nothing either.
TEST_F(TintImages, TintedBlocksTakeItAndOthersDoNot) {
    const base::Image grass = imageOf("grass"), stone = imageOf("stone");
    EXPECT_TRUE(renderer_->useTint(true));
    const auto expectPlain = [&] {
        const base::Image image = imageOf("grass");
        for (std::size_t k = 0; k < image.rgba.size(); ++k) ASSERT_NEAR(image.rgba[k], grass.rgba[k], 1);
    };
    expectPlain();
    tintAll(world::kNeutralTint);
    expectPlain();
    tintAll(world::packColor(130, 110, 60));
    const Mean plain = meanOf(grass), dry = meanOf(imageOf("grass"));
    EXPECT_GT(dry[0], plain[0] + 15);
    EXPECT_LT(dry[1], plain[1] - 10);
    EXPECT_EQ(imageOf("stone").rgba, stone.rgba);
    EXPECT_TRUE(renderer_->useTint(false));
    EXPECT_EQ(imageOf("grass").rgba, grass.rgba) << "none again";
}

// Of grass seen from above all texels are tinted.
TEST_F(TintImages, ShadersTintAsTheCpuDoes) {
    EXPECT_TRUE(renderer_->useTint(true));
    const base::Image plain = imageOf("grass");
    for (const world::PackedColor tint : {world::packColor(190, 60, 110), world::packColor(40, 200, 30)}) {
        tintAll(tint);
        const base::Image image = imageOf("grass");
        int worst = 0;
        for (std::size_t k = 0; k < image.rgba.size(); k += 4) {
            const glm::vec3 color(plain.rgba[k], plain.rgba[k + 1], plain.rgba[k + 2]);
            const glm::vec3 expected = 255.0f * world::tinted(color / 255.0f, tint);
            for (int c = 0; c < 3; ++c) {
                const int got = image.rgba[k + static_cast<std::size_t>(c)];
                worst = std::max(worst, std::abs(got - static_cast<int>(std::lround(expected[c]))));
            }
        }
        // The slope of the curve, up to 5, amplifies the rounding to 8 bits.
        EXPECT_LE(worst, 6) << std::hex << tint;
    }
}

// On the side of a grass block soil keeps its color.
TEST_F(TintImages, AlphaIsTheShareOfTheTintAndTilesHaveTheMeanColor) {
    const auto side = [&] {
        renderer_->clearChunks();
        renderer_->setChunk({0, 0}, floorOf("grass"));
        return draw(noon({.position = {8, -1.1, 100.5}, .yaw = 90, .fieldOfView = 40}));
    };
    const base::Image plain = side();
    tintAll(world::packColor(190, 50, 100));
    const base::Image red = side();
    const auto change = [&](int y) { return std::abs(pixel(red, 48, y)[0] - pixel(plain, 48, y)[0]); };
    EXPECT_GT(change(10), 40) << "grass";
    EXPECT_LE(change(58), 1) << "soil";

    // From afar texels are small on screen: the color of a tile is the mean of what blocks have nearby.
    tintAll(world::packColor(150, 130, 70));
    const Mean near = meanOf(imageOf("grass"));
    renderer_->clearChunks();
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) renderer_->setChunk({x, y, 4}, floorOf("grass"));
    Camera high = kFromAbove;
    high.position.z = 250;
    const Mean far = meanOf(draw(noon(high)));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(near[c], far[c], 2.5) << c;
}

// Red and green columns side by side.
TEST_F(TintImages, ColorsAreBlendedBetweenTexels) {
    EXPECT_TRUE(renderer_->useTint(true));
    for (const world::ChunkPos pos : renderer_->tintClipmap().missing({0, 0}, 1e6, SIZE_MAX)) {
        world::TintTile tile;
        for (std::size_t k = 0; k < tile.size(); ++k)
            tile[k] = pos.x * 16 + static_cast<int>(k % 16) < 2 ? world::packColor(150, 60, 50)
                                                                : world::packColor(40, 135, 50);
        if (pos.level == 2) renderer_->setTint(pos, tile);
    }
    // The edge at block 8 lies in the middle of the floor: the mean of both columns there.
    const base::Image image = imageOf("grass");
    const auto redOfRow = [&](int y) {
        int sum = 0;
        for (int x = 0; x < kImageSize.x; ++x) sum += pixel(image, x, y)[0];
        return sum / kImageSize.x;
    };
    const int low = redOfRow(62), middle = redOfRow(32), high = redOfRow(2);
    EXPECT_GT(std::abs(low - high), 40);
    EXPECT_NEAR(middle, (low + high) / 2, 20);
}

}  // namespace
}  // namespace terrane::render
