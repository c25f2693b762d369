// Hidden surfaces are not drawn, and nothing else is missing.
#include <random>

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

    // Hills of random columns with plants that wave, leaves, water and a tile of land behind them.
    void setRandomLand(std::mt19937& random) {
        const auto pick = [&](int count) {
            return static_cast<int>(random() % static_cast<unsigned>(count));
        };
        const std::array tops = {"oak_leaves", "grass_tuft", "poppy", "water", "cyan_glass", "stone"};
        for (int tile = 0; tile < 9; ++tile) {
            world::Chunk chunk;
            for (int column = 0; column < 256; ++column) {
                const int height = 4 + pick(3) + (column / 16 + tile) % 5 * pick(2);
                for (int z = 0; z < height; ++z)
                    chunk.setBlock(world::blockIndex(column % 16, column / 16, z), contentBlock("stone"));
                if (pick(3) > 0)
                    chunk.setBlock(world::blockIndex(column % 16, column / 16, height),
                                   contentBlock(tops[static_cast<std::size_t>(pick(6))]));
            }
            const world::ChunkPos pos{tile % 3 - 1, tile / 3 - 1,
                                      static_cast<std::uint8_t>(tile > 5 ? 2 : 0)};
            ASSERT_TRUE(renderer_->setChunk(pos, mesh::meshAlone(chunk, contentBlocks())));
        }
    }

    base::Image drawWith(bool culls, int samples, const FrameInput& input) {
        RenderOptions options = plainOptions(samples);
        options.occlusionCulling = culls;
        options.animation = true;
        EXPECT_TRUE(renderer_->configure({192, 128}, options));
        return draw(input);
    }

    // Quads of a later frame: those visible in the frame before are drawn first.
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
    const std::size_t both = quadsSeenBy(camera);
    for (int x = -2; x <= 2; ++x) renderer_->removeChunk({x, 1, 3});
    EXPECT_GT(both, quadsSeenBy(camera));
}

// Each frame of a walk whose steps are large and small, with edits on the way.
TEST_F(OcclusionCulling, EveryPixelIsAsWithout) {
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution(low, high)(random);
    };
    for (const int samples : {1, 4}) {
        setRandomLand(random);
        Camera camera{{8, 8, 12}};
        for (int step = 0; step < 40; ++step) {
            const double size = step % 4 == 0 ? 8 : 0.2;
            camera.position += glm::dvec3(between(-size, size), between(-size, size), 0);
            camera.position.z = between(6, 18);
            camera.yaw += static_cast<float>(between(-10 * size, 10 * size));
            camera.pitch = static_cast<float>(between(-40, 10));
            if (step % 10 == 9) setRandomLand(random);
            FrameInput input = noon(camera);
            input.timeSeconds = static_cast<float>(step);
            const base::Image culled = drawWith(true, samples, input);
            ASSERT_TRUE(culled.rgba == drawWith(false, samples, input).rgba) << samples << ", " << step;
        }
    }
}

}  // namespace
}  // namespace terrane::render
