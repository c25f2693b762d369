// Rays draw the golden images of quads: every face, texture, liquid and layer of the galleries. And the proof
// that these comparisons detect errors of rays.
#include "tests/golden/golden_fixture.h"
#include "tests/world/dam.h"

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
    EXPECT_TRUE(matchesGolden("gallery_above", drawByRays(galleryWorld(kFirstGallery, 4), kAbove), false));
    EXPECT_TRUE(matchesGolden("gallery_land", drawByRays(galleryWorld(kLandGallery, 3), kLand), false));
    EXPECT_TRUE(matchesGolden("gallery_cubes", drawByRays(galleryWorld(kCubesGallery, 3), kLand), false));
    EXPECT_TRUE(matchesGolden("gallery_shapes", drawByRays(galleryWorld(kShapesGallery, 3), kShapes), false));
    world::World world = emptyWorld(1);
    placeGallery(world);
    EXPECT_TRUE(matchesGolden("gallery_below", drawByRays(world, kBelow), false));
}

TEST_F(GoldenRays, Flow) {
    world::World world;
    for (const world::ChunkPos pos : world::damChunks())
        world.insert(pos, world::damChunk(pos, contentBlocks()));
    std::vector<world::BlockEdit> edits;
    world::breakDam(world, contentBlocks(), edits);
    for (int tick = 0; tick < 30; ++tick) world::flowLiquids(world, contentBlocks(), world::kDamArea, edits);
    EXPECT_TRUE(matchesGolden("flow", drawByRays(world, {{31, 19, 59}, 153, -24, 55}), false));
}

// Rays that miss any one block are noticed, whatever its shape.
TEST_F(GoldenRays, AMissingBlockIsNoticed) {
    const world::World world = galleryWorld(kShapesGallery, 3);
    const base::Image right = drawByRays(world, kShapes);
    for (const char* name : {"oak_stairs", "glass_pane", "white_carpet", "oak_fence", "ladder", "torch", "sign"})
        EXPECT_FALSE(isSame(right, drawByRays(world, kShapes, contentBlock(name)))) << name;
}

}  // namespace
}  // namespace terrane::golden
