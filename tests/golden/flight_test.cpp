// Images must not depend on hidden mesh sections or on the position in the world.
#include "terrane/content/built_in.h"
#include "terrane/view/camera_path.h"
#include "tests/golden/effect_scenes.h"
#include "tests/support/depth.h"

namespace terrane::golden {
namespace {

using render::RenderOptions;

// A camera flight over hills and through a forest, with turns and jumps.
render::Camera cameraOfFrame(int frame) {
    render::Camera camera = view::cameraOf(content::findScene("landscape")->pose);
    const int leg = frame / 15;
    const double t = frame % 15;
    camera.position += glm::dvec3(6 * t - 30 * leg, 20 * leg - 2 * t, leg == 2 ? -25 : -1.5 * t);
    camera.yaw += static_cast<float>(70 * leg + 6 * t);
    return camera;
}

class Flight : public GoldenTest {
  protected:
    static void configure(render::Renderer& renderer, const RenderOptions& options) {
        const auto configured = renderer.configure(kImageSize, options);
        ASSERT_TRUE(configured) << (configured ? "" : configured.error().message);
    }

    // Mesh sections that become visible are drawn in the very next image. `maxPixels`: allowed different
    // pixels.
    void expectNothingMissed(RenderOptions visible, int frames, int maxPixels) {
        constexpr int kViewDistance = 10;
        render::Renderer& renderer = emptyRenderer();
        loadOverworld(renderer, cameraOfFrame(0), kViewDistance);
        RenderOptions all = visible;
        all.occlusionCulling = false;
        std::size_t quadsOfAll = 0, quadsOfVisible = 0;
        for (int frame = 0; frame < frames; ++frame) {
            const render::FrameInput input{cameraOfFrame(frame), world::environmentAt(0.4f),
                                           16.0f * kViewDistance, 0, render::View::Color};
            configure(renderer, visible);
            const base::Image seen = draw(renderer, input);
            quadsOfVisible += renderer.statistics().quads;
            configure(renderer, all);
            const base::Image whole = draw(renderer, input);
            quadsOfAll += renderer.statistics().quads;
            int different = 0;
            for (std::size_t at = 0; at < seen.rgba.size(); at += 4)
                different += !std::equal(&seen.rgba[at], &seen.rgba[at] + 4, &whole.rgba[at]);
            ASSERT_LE(different, maxPixels) << "frame " << frame;
        }
        EXPECT_LT(quadsOfVisible, quadsOfAll * 9 / 10) << "something is hidden";
    }
};

TEST_F(Flight, HiddenMeshSectionsAreNeverMissed) {
    RenderOptions options = render::plainOptions(1);
    options.tJunctions = render::TJunctions::Open;
    expectNothingMissed(options, atDepth(31, 60), 0);
}

// Covering quads overlap: at equal depth the first one drawn wins, and culling changes the order.
TEST_F(Flight, HiddenMeshSectionsAreNeverMissedBetweenCoveringQuads) {
    RenderOptions options = render::plainOptions(1);
    options.tJunctions = render::TJunctions::Covered;
    expectNothingMissed(options, atDepth(16, 30), 2);
}

// The gallery near the origin and at 2^30, with everything that depends on the position: shadows, waves,
// clouds.
TEST_F(Flight, TheWorldIsTheSameFarAway) {
    world::World world = flatWorld(3);
    placeGallery(world);
    placePool(world);
    const Meshes meshes = meshWorld(world);
    RenderOptions options;
    options.msaaSamples = 1;
    const auto imageAt = [&](int chunkX, int chunkY) {
        render::Renderer& renderer = emptyRenderer();
        configure(renderer, options);
        for (const auto& [pos, mesh] : meshes) renderer.setChunk({pos.x + chunkX, pos.y + chunkY}, mesh);
        render::Camera camera = kAbove;
        camera.position = glm::round(camera.position * 64.0) / 64.0;  // keeps sums exact
        camera.position += glm::dvec3(16.0 * chunkX, 16.0 * chunkY, 0);
        return draw(renderer, {camera, world::environmentAt(0.34f), 400, 7.5f, render::View::Color});
    };
    const base::Image near = imageAt(0, 0);
    for (const int far : {1 << 26, -(1 << 26)}) {
        const base::Image there = imageAt(far, -far);
        for (std::size_t k = 0; k < near.rgba.size(); ++k) ASSERT_NEAR(near.rgba[k], there.rgba[k], 2) << far;
    }
}

}  // namespace
}  // namespace terrane::golden
