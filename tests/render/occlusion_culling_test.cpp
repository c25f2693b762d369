// What lies behind other things is not drawn.
#include "terrane/mesh/chunk_mesher.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

class OcclusionCulling : public RendererTest {
  protected:
    void SetUp() override {
        RendererTest::SetUp();
        if (IsSkipped()) return;
        RenderOptions options = plainOptions(1);
        options.occlusionCulling = true;
        ASSERT_TRUE(renderer_->configure({192, 128}, options));
    }

    // Columns of stone along the row y, so many blocks high.
    static mesh::ChunkMesh rowMesh(int y, int height) {
        world::Chunk chunk;
        for (int k = 0; k < 16 * height; ++k)
            chunk.setBlock(world::blockIndex(k % 16, y, k / 16), contentBlock("stone"));
        return mesh::meshAlone(chunk, contentBlocks());
    }

    // Of a later frame: what was visible in the one before is drawn first.
    std::size_t quadsSeenBy(const Camera& camera) {
        for (int frame = 0; frame < 8; ++frame) draw(noon(camera));
        return renderer_->statistics().quads;
    }
};

// The box of a tile far away is wide and flat. It ends just below the top of the wall in front of it.
TEST_F(OcclusionCulling, LowLandBehindAWallIsHidden) {
    constexpr int kEyes = 25;
    Camera camera{{8, 8, kEyes}};
    while (lookDirection(camera).y < 0.9) camera.yaw += 90;
    for (int x = -6; x <= 6; ++x) ASSERT_TRUE(renderer_->setChunk({x, 1}, rowMesh(8, kEyes + 7)));
    const std::size_t wall = quadsSeenBy(camera);
    EXPECT_GT(wall, 0u);
    for (int x = -2; x <= 2; ++x) ASSERT_TRUE(renderer_->setChunk({x, 1, 3}, rowMesh(0, kEyes + 2)));
    EXPECT_EQ(quadsSeenBy(camera), wall);
    camera.position.z += 20;
    EXPECT_GT(quadsSeenBy(camera), wall);
}

}  // namespace
}  // namespace terrane::render
