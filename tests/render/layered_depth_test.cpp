// What is far behind glass is as sharp as the glass: depth of field goes by the nearest surface, blended or
// not.
#include <cmath>

#include "terrane/mesh/chunk_mesher.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

// A wall across a chunk, from z = 90 to 110.
template <class BlockAt>
mesh::ChunkMesh wallAcross(int x, BlockAt blockAt) {
    world::Chunk chunk;
    const world::Chunk air;
    for (int y = 0; y < world::kChunkSize; ++y)
        for (int z = 90; z <= 110; ++z)
            chunk.setBlock(world::blockIndex(x, y, z), contentBlock(blockAt(y, z)));
    mesh::MeshScratch scratch;
    return mesh::meshChunk({&chunk, {&air, &air, &air, &air}, &contentBlocks(), {}}, scratch);
}

double meanDifference(const base::Image& a, const base::Image& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.rgba.size(); ++k) sum += std::abs(int{a.rgba[k]} - int{b.rgba[k]});
    return sum / static_cast<double>(a.rgba.size());
}

class LayeredDepth : public RendererTest {
  protected:
    // How much depth of field changes the image of a checkered wall 190 blocks away.
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
        {12, 0}, wallAcross(5, [](int y, int z) { return (y + z) % 2 == 0 ? "stone" : "snow"; })));
    for (const int samples : {1, 4}) {
        const double farWall = blur(samples);
        EXPECT_GT(farWall, 1.0) << samples;
        ASSERT_TRUE(renderer_->setChunk({0, 0}, wallAcross(12, [](int, int) { return "cyan_glass"; })));
        EXPECT_LT(blur(samples), 0.1 * farWall) << samples;
        renderer_->removeChunk({0, 0});
    }
}

}  // namespace
}  // namespace terrane::render
