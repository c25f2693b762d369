// Golden images by rays, and the proof that they detect errors. tests/render/rays_pass_test.cpp compares rays
// with quads.
#include "tests/golden/golden_fixture.h"

namespace terrane::golden {
namespace {

class GoldenRays : public GoldenTest {
  protected:
    // `hidden`: a block that is left out, or air.
    static base::Image drawByRays(const world::World& world, const render::Camera& camera,
                                  world::BlockId hidden = world::kAir) {
        render::Renderer& renderer = emptyRenderer();
        render::RenderOptions options = renderer.options();
        options.surfaces = render::SurfaceMethod::Rays;
        EXPECT_TRUE(renderer.configure(kImageSize, options));
        for (const auto& [pos, mesh] : meshWorld(world)) {
            auto chunk = std::make_shared<world::Chunk>(*world.maybeChunkAt(pos));
            for (world::BlockIndex k = 0; hidden != world::kAir && k < 256 * 256; ++k)
                if (chunk->block(k) == hidden) chunk->setBlock(k, world::kAir);
            EXPECT_TRUE(renderer.setBlocks(pos, std::move(chunk)));
        }
        base::Image image = draw(renderer, galleryFrame(camera));
        options.surfaces = render::SurfaceMethod::Quads;
        EXPECT_TRUE(renderer.configure(kImageSize, options));
        return image;
    }

    static world::World galleryWorld(std::string_view gallery, int radius) {
        world::World world = flatWorld(radius);
        placeGallery(world, gallery);
        return world;
    }
};

TEST_F(GoldenRays, Galleries) {
    EXPECT_TRUE(matchesGolden("rays_land", drawByRays(galleryWorld(kLandGallery, 3), kLand)));
    EXPECT_TRUE(matchesGolden("rays_shapes", drawByRays(galleryWorld(kShapesGallery, 3), kShapes)));
}

// Rays that miss any one block are noticed, whatever its shape.
TEST_F(GoldenRays, AMissingBlockIsNoticed) {
    const world::World world = galleryWorld(kShapesGallery, 3);
    const base::Image right = drawByRays(world, kShapes);
    for (const char* name :
         {"oak_stairs", "glass_pane", "white_carpet", "oak_fence", "ladder", "torch", "sign"})
        EXPECT_FALSE(isSame(right, drawByRays(world, kShapes, contentBlock(name)))) << name;
}

}  // namespace
}  // namespace terrane::golden
