// The golden images; README.md describes each and how to update them.
#include "terrane/content/built_in.h"
#include "terrane/view/camera_path.h"
#include "tests/golden/axes_cube.h"
#include "tests/golden/effect_scenes.h"
#include "tests/world/dam.h"

namespace terrane::golden {
namespace {

class Golden : public GoldenTest {
  protected:
    static base::Image drawGallery(render::Renderer& renderer, const Meshes& meshes,
                                   const render::Camera& camera) {
        for (const auto& [pos, mesh] : meshes) renderer.setChunk(pos, mesh);
        return drawBothWays(renderer, galleryFrame(camera));
    }
};

TEST_F(Golden, GalleryFromAbove) {
    render::Renderer& renderer = emptyRenderer();
    EXPECT_TRUE(matchesGolden("gallery_above", drawGallery(renderer, galleryOnGround(), kAbove)));
}

TEST_F(Golden, GalleryOfTheLand) {
    render::Renderer& renderer = emptyRenderer();
    EXPECT_TRUE(matchesGolden("gallery_land", drawGallery(renderer, galleryOf(kLandGallery), kLand)));
}

TEST_F(Golden, GalleryOfCubesToBuildWith) {
    render::Renderer& renderer = emptyRenderer();
    EXPECT_TRUE(matchesGolden("gallery_cubes", drawGallery(renderer, galleryOf(kCubesGallery), kLand)));
}

TEST_F(Golden, GalleryOfShapes) {
    render::Renderer& renderer = emptyRenderer();
    EXPECT_TRUE(matchesGolden("gallery_shapes", drawGallery(renderer, galleryOf(kShapesGallery), kShapes)));
}

TEST_F(Golden, GalleryFromBelow) {
    render::Renderer& renderer = emptyRenderer();
    EXPECT_TRUE(matchesGolden("gallery_below", drawGallery(renderer, galleryInTheAir(), kBelow)));
}

TEST_F(Golden, PoolAtAFlatAngle) {
    world::World world = flatWorld(4);
    placePool(world);
    render::Renderer& renderer = emptyRenderer();
    EXPECT_TRUE(
        matchesGolden("pool", drawGallery(renderer, meshWorld(world), {{-1.5, -4, 82.8}, 50, -9, 55})));
}

// Shading at the corners of quads: blocks that glow, are tinted, tested and blended.
TEST_F(Golden, GalleryShadedAtCorners) {
    render::Renderer& renderer = emptyRenderer();
    render::RenderOptions options = renderer.options();
    options.shading = render::Shading::Corners;
    ASSERT_TRUE(renderer.configure(kImageSize, options));
    EXPECT_TRUE(matchesGolden("gallery_corners", drawGallery(renderer, galleryOnGround(), kAbove)));
}

// A broken dam: water of all levels, falls, steps between them and the lake above.
TEST_F(Golden, Flow) {
    world::World world;
    for (const world::ChunkPos pos : world::damChunks())
        world.insert(pos, world::damChunk(pos, contentBlocks()));
    std::vector<world::BlockEdit> edits;
    world::breakDam(world, contentBlocks(), edits);
    for (int tick = 0; tick < 30; ++tick) world::flowLiquids(world, contentBlocks(), world::kDamArea, edits);
    render::Renderer& renderer = emptyRenderer();
    EXPECT_TRUE(matchesGolden("flow", drawGallery(renderer, meshWorld(world), {{31, 19, 59}, 153, -24, 55})));
}

TEST_F(Golden, AxesOfACube) {
    render::Renderer renderer = makeRenderer(cubeTexture, cubeBlocks());
    renderer.setChunk({0, 0}, cubeMesh());
    EXPECT_TRUE(matchesGolden("cube_negative_sides", drawBothWays(renderer, cubeFrame(kCubeNegative))));
    EXPECT_TRUE(matchesGolden("cube_positive_sides", drawBothWays(renderer, cubeFrame(kCubePositive))));
}

TEST_F(Golden, Landscape) {
    constexpr int kViewDistance = 10;
    const content::Scene* scene = content::findScene("landscape");
    ASSERT_TRUE(scene);
    render::Renderer& renderer = emptyRenderer();
    const render::Camera camera = view::cameraOf(scene->pose);
    loadOverworld(renderer, camera, kViewDistance);
    render::FrameInput input{camera, world::environmentAt(scene->timeDay), 16.0f * kViewDistance, 0,
                             render::View::Color};
    EXPECT_TRUE(matchesGolden("landscape_color", drawBothWays(renderer, input)));
    input.view = render::View::Normal;
    EXPECT_TRUE(matchesGolden("landscape_normal", draw(renderer, input)));
    input.view = render::View::Depth;
    EXPECT_TRUE(matchesGolden("landscape_depth", draw(renderer, input)));
    input.view = render::View::Light;
    EXPECT_TRUE(matchesGolden("landscape_light", draw(renderer, input)));
    input.view = render::View::Merging;
    EXPECT_TRUE(matchesGolden("landscape_merging", draw(renderer, input)));
}

// All merge methods and mesh section heights give the image of single faces. Normals are compared in the
// desert: at leaf borders they differ from sample to sample.
TEST_F(Golden, MergeMethodsDrawTheSameImage) {
    constexpr int kViewDistance = 4;
    using mesh::MergeMethod;
    const auto imageOf = [&](std::string_view scene, const mesh::MeshOptions& options, render::View view) {
        const render::Camera camera = view::cameraOf(content::findScene(scene)->pose);
        render::Renderer& renderer = emptyRenderer();
        loadOverworld(renderer, camera, kViewDistance, options);
        return draw(renderer, {camera, world::environmentAt(0.4f), 16.0f * kViewDistance, 0, view});
    };
    for (const auto& [scene, view] :
         {std::pair("landscape", render::View::Color), {"desert", render::View::Normal}}) {
        const base::Image expected = imageOf(scene, {MergeMethod::None}, view);
        for (const mesh::MeshOptions options : {mesh::MeshOptions{MergeMethod::Lines, 8},
                                                {MergeMethod::Squares, 16},
                                                {MergeMethod::SquaresExt, 32},
                                                {MergeMethod::Greedy, 64},
                                                {MergeMethod::Greedy, 128}}) {
            const Difference d = difference(expected, imageOf(scene, options, view));
            EXPECT_LE(d.max, kTolerance.max) << scene << ", method " << static_cast<int>(options.method);
            EXPECT_LE(d.mean, kTolerance.mean) << scene << ", method " << static_cast<int>(options.method);
        }
    }
    // The merging view does differ.
    EXPECT_FALSE(isSame(imageOf("desert", {MergeMethod::None}, render::View::Merging),
                        imageOf("desert", {MergeMethod::Greedy}, render::View::Merging)));
}

}  // namespace
}  // namespace terrane::golden
