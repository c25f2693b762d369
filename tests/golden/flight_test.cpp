// Pictures that must not depend on what they do not show: hidden regions, the place in the world.
#include "apps/terrane/scenes.h"
#include "tests/golden/effect_scenes.h"

namespace terrane::golden {
namespace {

using render::RenderOptions;

class Flight : public GoldenTest {
  protected:
    static void configure(render::Renderer& renderer, const RenderOptions& options) {
        const auto configured = renderer.configure(kPictureSize, options);
        ASSERT_TRUE(configured) << (configured ? "" : configured.error().message);
    }
};

// Over hills and through a forest, turning, with jumps: regions that come into view after being hidden are in
// the very next picture.
TEST_F(Flight, HiddenRegionsAreNeverMissed) {
    constexpr int kViewDistance = 10, kFrames = 60;
    const render::Camera start = app::findScene("landscape")->camera;
    render::Renderer renderer = makeRenderer();
    loadOverworld(renderer, start, kViewDistance);
    RenderOptions visible = render::plainOptions(1);
    // Covering quads overlap: where their depths are equal the first one drawn stays.
    visible.tJunctions = render::TJunctions::Open;
    RenderOptions all = visible;
    all.hiddenRegionCulling = false;
    std::size_t quadsOfAll = 0, quadsOfVisible = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        render::Camera camera = start;
        const int leg = frame / 15;
        const double t = frame % 15;
        camera.position += glm::dvec3(6 * t - 30 * leg, 20 * leg - 2 * t, leg == 2 ? -25 : -1.5 * t);
        camera.yaw += static_cast<float>(70 * leg + 6 * t);
        render::FrameInput input{camera, world::environmentAt(0.4f), 16.0f * kViewDistance, 0,
                                 render::View::Color};
        configure(renderer, visible);
        const base::Image seen = draw(renderer, input);
        quadsOfVisible += renderer.statistics().quads;
        configure(renderer, all);
        ASSERT_EQ(draw(renderer, input).rgba, seen.rgba) << "frame " << frame;
        quadsOfAll += renderer.statistics().quads;
    }
    EXPECT_LT(quadsOfVisible, quadsOfAll * 9 / 10) << "something is hidden";
}

// The gallery near the middle of the world and at 2^30, with everything that depends on the place: shadows,
// waves, clouds.
TEST_F(Flight, TheWorldIsTheSameFarAway) {
    world::World world = flatWorld(3);
    placeGallery(world);
    placePool(world);
    const Meshes meshes = meshWorld(world);
    RenderOptions options;
    options.samples = 1;
    const auto pictureAt = [&](int chunkX, int chunkY) {
        render::Renderer renderer = makeRenderer();
        configure(renderer, options);
        for (const auto& [pos, mesh] : meshes) renderer.setChunk({pos.x + chunkX, pos.y + chunkY}, mesh);
        render::Camera camera = kAbove;
        camera.position = glm::round(camera.position * 64.0) / 64.0;  // so that sums are exact
        camera.position += glm::dvec3(16.0 * chunkX, 16.0 * chunkY, 0);
        return draw(renderer, {camera, world::environmentAt(0.34f), 400, 7.5f, render::View::Color});
    };
    const base::Image near = pictureAt(0, 0);
    for (const int far : {1 << 26, -(1 << 26)}) {
        const base::Image there = pictureAt(far, -far);
        for (std::size_t k = 0; k < near.rgba.size(); ++k) ASSERT_NEAR(near.rgba[k], there.rgba[k], 2) << far;
    }
}

}  // namespace
}  // namespace terrane::golden
