// A long flight with random options: no error of the driver, no frame that depends on the options before it.
#include <algorithm>
#include <random>

#include "terrane/render/frame/renderer.h"
#include "tests/golden/scenes.h"
#include "tests/gpu/gl_fixture.h"
#include "tests/render/content.h"
#include "tests/support/depth.h"

namespace terrane::render {
namespace {

constexpr int kFramesOfOptions = 12;

class Tour : public gpu::GlTest {
  protected:
    RenderOptions randomOptions() {
        const auto pick = [&](int count) {
            return static_cast<int>(random_() % static_cast<unsigned>(count));
        };
        RenderOptions o;
        // A new option does not compile here before it is set below.
        [[maybe_unused]] const auto& [samples, shading, light, shadows, shadowSize, soft, occlusion,
                                      depthOfField, fog, rays, bloom, clouds, animation, adaptation,
                                      filtering, alphaTest, water, layers, single, junctions, culling, backs,
                                      scale, upscaling, draw, surfaces] = o;
        o.msaaSamples = 1 << pick(3);
        o.shading = static_cast<Shading>(pick(4));
        o.light = static_cast<LightSampling>(pick(2));
        o.shadows = static_cast<ShadowReach>(pick(4));
        o.shadowSize = 256;
        o.softShadows = pick(2) == 0;
        o.occlusion = static_cast<Occlusion>(pick(3));
        o.depthOfField = pick(2) == 0;
        o.distanceFog = pick(4) > 0;
        o.godRays = pick(2) == 0;
        o.bloom = pick(2) == 0;
        o.clouds = pick(2) == 0;
        o.animation = pick(2) == 0;
        o.adaptation = pick(2) == 0;
        o.sharpFiltering = pick(2) == 0;
        o.msaaAlphaTest = pick(2) == 0;
        o.water = static_cast<Water>(pick(2));
        o.transparencyLayers = pick(4);
        o.singleTransparencyLayer = pick(8) == 0 ? 1 + pick(3) : 0;
        o.tJunctions = static_cast<TJunctions>(pick(3));
        o.occlusionCulling = pick(2) == 0;
        o.leafBacks = pick(2) == 0;
        o.renderScale = pick(3) == 0 ? 25 + pick(200) : 100;
        o.upscaling = static_cast<Upscaling>(pick(4));
        o.draw = static_cast<DrawMethod>(pick(3));
        // Rays have no quads whose corners could be shaded.
        o.surfaces =
            o.shading == Shading::Corners ? SurfaceMethod::Quads : static_cast<SurfaceMethod>(pick(2));
        return o;
    }

    std::minstd_rand random_{7};
};

FrameInput frameOf(int frame) {
    const double angle = 0.02 * frame;
    const Camera camera{{6 + 14 * std::cos(angle), 4 + 12 * std::sin(angle), 84 + 3 * std::sin(0.7 * angle)},
                        static_cast<float>(180 + 57.3 * angle),
                        static_cast<float>(-12 + 20 * std::sin(0.31 * angle))};
    const float time = static_cast<float>(frame % 500) / 500;
    return {camera,
            world::environmentAt(time),
            60,
            0.05f * static_cast<float>(frame),
            frame % 97 < 8 ? static_cast<View>(frame % 5) : View::Color,
            frame % 211 < 10};
}

TEST_F(Tour, AnyOptionsInAnyOrder) {
    auto made = Renderer::create(contentShaders(), contentBlocks(), contentTexture, gpu::queryDevice());
    ASSERT_TRUE(made) << made.error().message;
    world::World world = golden::flatWorld(3);
    golden::placeGallery(world);
    golden::placePool(world);
    const golden::Meshes meshes = golden::meshWorld(world);
    for (const auto& [pos, mesh] : meshes) made->setChunk(pos, mesh);
    const int most = gpu::queryDevice().maxSamples;
    std::optional<base::Image> first;
    const int frames = atDepth(126, 1001);
    for (int frame = 0; frame < frames; ++frame) {
        if (frame % kFramesOfOptions == 0) {
            RenderOptions options = randomOptions();
            options.msaaSamples = std::min(options.msaaSamples, most);
            const glm::ivec2 size = frame % 36 == 0 ? glm::ivec2(33, 17 + frame % 31) : glm::ivec2(64, 40);
            const auto configured = made->configure(size, options);
            ASSERT_TRUE(configured) << configured.error().message;
        }
        if (frame % 7 == 0) made->removeChunk({1, 1});
        if (frame % 7 == 3) made->setChunk({1, 1}, meshes.at({1, 1}));
        made->draw(frameOf(frame));
        ASSERT_EQ(context().debugErrorCount(), 0) << "frame " << frame;
        if (frame % 25 > 0) continue;
        // Earlier frames leave no trace.
        made->setChunk({1, 1}, meshes.at({1, 1}));
        ASSERT_TRUE(made->configure({64, 40}, RenderOptions{}));
        made->draw(frameOf(3));
        const base::Image again = made->readImage();
        if (!first) first = again;
        EXPECT_EQ(again.rgba, first->rgba) << "frame " << frame;
    }
}

// Layers are drawn only if blended faces may be visible.
TEST_F(Tour, LayersCostNothingWithoutBlendedFaces) {
    auto made = Renderer::create(contentShaders(), contentBlocks(), contentTexture, gpu::queryDevice());
    ASSERT_TRUE(made) << made.error().message;
    world::World world = golden::flatWorld(3);
    golden::placePool(world);
    for (const auto& [pos, mesh] : golden::meshWorld(world)) made->setChunk(pos, mesh);
    ASSERT_TRUE(made->configure({64, 40}, plainOptions(1)));
    const auto hasPeeled = [&](float yaw) {
        for (int frame = 0; frame < 6; ++frame) {
            made->draw({{{-20, 8, 84}, yaw, -5}, world::environmentAt(0.5f), 400, 0, View::Color});
            made->readImage();
        }
        return std::ranges::any_of(made->passTimes(),
                                   [](const gpu::GpuTiming& t) { return t.name == "peel"; });
    };
    EXPECT_TRUE(hasPeeled(0));
    EXPECT_FALSE(hasPeeled(180));
}

}  // namespace
}  // namespace terrane::render
