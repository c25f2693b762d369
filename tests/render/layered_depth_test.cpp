// Depth of field and ambient occlusion use the nearest surface, blended or not.
#include <cmath>

#include "terrane/mesh/chunk_mesher.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

// Walls across a chunk at the given x, from z = 90 to 110.
template <class BlockAt>
mesh::ChunkMesh wallsAcross(std::initializer_list<int> xs, BlockAt blockAt) {
    world::Chunk chunk;
    for (const int x : xs)
        for (int y = 0; y < world::kChunkSize; ++y)
            for (int z = 90; z <= 110; ++z)
                chunk.setBlock(world::blockIndex(x, y, z), contentBlock(blockAt(x, y, z)));
    return mesh::meshAlone(chunk, contentBlocks());
}

double meanDifference(const base::Image& a, const base::Image& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.rgba.size(); ++k) sum += std::abs(int{a.rgba[k]} - int{b.rgba[k]});
    return sum / static_cast<double>(a.rgba.size());
}

class LayeredDepth : public RendererTest {
  protected:
    // Change that depth of field makes to the image of a checkered wall 190 blocks away.
    double blur(int samples) {
        const FrameInput input{{{8, 8, 100}, 0, 0, 4}, world::environmentAt(0.5f), 4000, 0, View::Color};
        RenderOptions options = plainOptions(samples);
        EXPECT_TRUE(renderer_->configure(kImageSize, options));
        const base::Image sharp = draw(input);
        options.depthOfField = true;
        EXPECT_TRUE(renderer_->configure(kImageSize, options));
        return meanDifference(sharp, draw(input));
    }
};

TEST_F(LayeredDepth, GlassNearbyIsNotBlurredByWhatIsFarBehindIt) {
    ASSERT_TRUE(renderer_->setChunk(
        {12, 0}, wallsAcross({5}, [](int, int y, int z) { return (y + z) % 2 == 0 ? "stone" : "snow"; })));
    for (const int samples : {1, 4}) {
        const double farWall = blur(samples);
        EXPECT_GT(farWall, 1.0) << samples;
        ASSERT_TRUE(
            renderer_->setChunk({0, 0}, wallsAcross({12}, [](int, int, int) { return "cyan_glass"; })));
        EXPECT_LT(blur(samples), 0.1 * farWall) << samples;
        renderer_->removeChunk({0, 0});
    }
}

// A pane of glass in front of the sky, with a ledge of stone at it: the glass is occluded beside the ledge.
TEST_F(LayeredDepth, GlassIsOccludedByWhatStandsAtIt) {
    constexpr int kLedge = 11;
    const auto blockAt = [](int x, int, int z) { return x == 12 ? "cyan_glass" : z == 98 ? "stone" : "air"; };
    ASSERT_TRUE(renderer_->setChunk({0, 0}, wallsAcross({12, kLedge}, blockAt)));
    const FrameInput input = noon({{8, 8.5, 100}, 0, 0});
    for (const int samples : {1, 4}) {
        RenderOptions options = plainOptions(samples);
        options.occlusion = Occlusion::Raw;
        const auto configured = renderer_->configure(kImageSize, options);
        ASSERT_TRUE(configured) << configured.error().message;
        const base::Image raw = draw(input);
        // The top of the ledge lies 1 block below the camera and ends at the glass, 4 blocks ahead.
        const int middle = kImageSize.x / 2;
        int darkest = 255;
        for (int y = 32; y < 43; ++y) darkest = std::min(darkest, pixel(raw, middle, y)[0]);
        EXPECT_EQ(pixel(raw, middle, 20)[0], 255) << samples << ": open glass";
        EXPECT_LT(darkest, 225) << samples << ": the corner of glass and stone";
    }
}

}  // namespace
}  // namespace terrane::render
