// Draws each effect on and off: both match their golden images, and differ enough from each other.
#include <map>

#include "tests/golden/effect_scenes.h"

namespace terrane::golden {
namespace {

using render::Occlusion;
using render::RenderOptions;
using render::Shading;

class Effects : public GoldenTest {
  protected:
    void SetUp() override {
        GoldenTest::SetUp();
        if (IsSkipped()) return;
        renderer_ = &emptyRenderer();
        samples_ = std::min(kSamples, gpu::queryDevice().maxSamples);
    }

    // Plain options, changed by `change`.
    template <class Change>
    base::Image imageOf(const render::FrameInput& input, Change change) {
        RenderOptions options = render::plainOptions(samples_);
        change(options);
        const auto configured = renderer_->configure(kImageSize, options);
        EXPECT_TRUE(configured) << (configured ? "" : configured.error().message);
        return draw(*renderer_, input);
    }

    template <class Change>
    void expectEffect(const std::string& name, const render::FrameInput& input, Change change) {
        const base::Image off = imageOf(input, [](RenderOptions&) {}), on = imageOf(input, change);
        EXPECT_TRUE(matchesGolden(name, on));
        EXPECT_FALSE(isSame(on, off)) << name << " changes nothing";
    }

    render::Renderer* renderer_ = nullptr;
    int samples_ = 1;
};

TEST_F(Effects, InTheGlade) {
    loadOverworld(*renderer_, kGlade, kGladeDistance);
    const render::FrameInput afternoon = gladeFrame(kGlade, 0.62f), night = gladeFrame(kGlade, 0.97f);
    EXPECT_TRUE(matchesGolden("glade", imageOf(afternoon, [](RenderOptions&) {})));
    expectEffect("glade_shadows", afternoon, [](RenderOptions& o) {
        o.shadows = render::ShadowReach::Near;
        o.shadowSize = 1024;
    });
    expectEffect("glade_moon_shadows", night, [](RenderOptions& o) {
        o.shadows = render::ShadowReach::Far;
        o.softShadows = true;
    });
    expectEffect("glade_ssao", afternoon, [](RenderOptions& o) { o.occlusion = Occlusion::On; });
    expectEffect("glade_ssao_raw", afternoon, [](RenderOptions& o) { o.occlusion = Occlusion::Raw; });
    expectEffect("glade_no_atmosphere", afternoon, [](RenderOptions& o) { o.distanceFog = false; });
    expectEffect("glade_unlit", afternoon, [](RenderOptions& o) { o.shading = Shading::Off; });
    expectEffect("glade_corners", afternoon, [](RenderOptions& o) { o.shading = Shading::Corners; });
    expectEffect("glade_animation", afternoon, [](RenderOptions& o) { o.animation = true; });
    // Blocks a hundred blocks away blur a little: less than the tolerance between drivers, but more than
    // nothing.
    const base::Image plain = imageOf(afternoon, [](RenderOptions&) {});
    const base::Image blurred = imageOf(afternoon, [](RenderOptions& o) { o.depthOfField = true; });
    EXPECT_TRUE(matchesGolden("glade_far_blur", blurred));
    EXPECT_GT(difference(plain, blurred).mean, 0.05) << "the blur changes nothing";
}

TEST_F(Effects, OfTheSky) {
    loadOverworld(*renderer_, kTowardSun, kGladeDistance);
    for (const auto& [name, time] :
         {std::pair("morning", 0.24f), {"noon", 0.5f}, {"dusk", 0.79f}, {"night", 0.0f}}) {
        expectEffect(std::string("clouds_") + name, gladeFrame(kTowardSun, time),
                     [](RenderOptions& o) { o.clouds = true; });
    }
    expectEffect("god_rays", gladeFrame(kTowardSun, 0.76f), [](RenderOptions& o) { o.godRays = true; });
}

// A lamp in the dark, nearly black around it, and the same place by day.
TEST_F(Effects, OfBloom) {
    world::World world = flatWorld(2);
    world::putBlock(world, {8, 8, kGalleryZ}, contentBlock("lamp_white"));
    for (const auto& [pos, mesh] : meshWorld(world)) renderer_->setChunk(pos, mesh);
    const render::Camera camera{{8.5, 2.5, kGalleryZ + 1.6}, 90, -6, 50};
    render::FrameInput night{camera, world::environmentAt(0), 400, 0, render::View::Color};
    night.exposure = glm::vec3(2.5f);
    const auto withBloom = [](RenderOptions& o) { o.bloom = true; };
    expectEffect("bloom", night, withBloom);
    const base::Image off = imageOf(night, [](RenderOptions&) {}), on = imageOf(night, withBloom);
    // To the right of the lamp, in its row.
    const auto added = [&](int x) {
        const std::size_t at = 4 * static_cast<std::size_t>(kImageSize.y / 2 * kImageSize.x + x) + 1;
        return on.rgba[at] - off.rgba[at];
    };
    EXPECT_GT(added(kImageSize.x / 2 + 30), added(kImageSize.x / 2 + 60));
    EXPECT_GE(added(kImageSize.x - 1), 0);
    const render::FrameInput day{
        {camera.position, 270, -20, 50}, world::environmentAt(0.45f), 400, 0, render::View::Color};
    EXPECT_EQ(difference(imageOf(day, withBloom), imageOf(day, [](RenderOptions&) {})).max, 0)
        << "land by day is not so bright";
}

// One sample per pixel without the treatment of holes and edges, against several.
TEST_F(Effects, OfSamples) {
    loadOverworld(*renderer_, kGlade, kGladeDistance);
    const render::FrameInput input = gladeFrame({{-1020, -60, 91}, 200, -14, 25}, 0.62f);
    expectEffect("samples_one", input, [](RenderOptions& o) { o.msaaSamples = 1; });
    expectEffect("samples_plain_texturing", input, [](RenderOptions& o) { o.sharpFiltering = false; });
    // A few pixels along edges: less than the tolerance between drivers, but more than nothing.
    const base::Image plain = imageOf(input, [](RenderOptions&) {});
    const base::Image tested = imageOf(input, [](RenderOptions& o) { o.msaaAlphaTest = true; });
    const base::Image once = imageOf(input, [](RenderOptions& o) { o.shading = Shading::Pixel; });
    EXPECT_TRUE(matchesGolden("samples_alpha_test", tested));
    EXPECT_TRUE(matchesGolden("samples_shaded_once", once));
    EXPECT_GT(difference(plain, tested).max, 8) << "the alpha test of samples changes nothing";
    EXPECT_GT(difference(plain, once).mean, 0.02) << "shading once a pixel changes nothing";
}

// Rows of glass behind each other, with water between them.
TEST_F(Effects, OfLayers) {
    world::World world = flatWorld(3);
    for (int row = 0; row < 4; ++row) {
        for (int x = 0; x < 4 + row; ++x)
            world::putBlock(world, {x, 3 * row, kGalleryZ}, contentBlock("cyan_glass"));
    }
    for (int x = 0; x < 4; ++x) world::putBlock(world, {x, 4, kGalleryZ}, contentBlock("water"));
    for (const auto& [pos, mesh] : meshWorld(world)) renderer_->setChunk(pos, mesh);
    const render::FrameInput input{
        {{2.0, -4.5, 83}, 88, -14, 50}, world::environmentAt(0.4f), 400, 0, render::View::Color};
    std::map<int, base::Image> byLayers, single;
    for (int layers = 0; layers <= 3; ++layers) {
        byLayers[layers] = imageOf(input, [&](RenderOptions& o) { o.transparencyLayers = layers; });
        EXPECT_TRUE(matchesGolden("layers_" + std::to_string(layers), byLayers[layers]));
        if (layers == 0) continue;
        EXPECT_FALSE(isSame(byLayers[layers], byLayers[layers - 1])) << layers;
        single[layers] = imageOf(input, [&](RenderOptions& o) { o.singleTransparencyLayer = layers; });
        EXPECT_TRUE(matchesGolden("layer_alone_" + std::to_string(layers), single[layers]));
        if (layers > 1) {
            EXPECT_FALSE(isSame(single[layers], single[layers - 1])) << layers;
        }
    }
}

// With one sample the quads are drawn twice instead of a full-screen pass: another way to the same image.
TEST_F(Effects, WaterIsTheSameBothWays) {
    world::World world = flatWorld(3);
    placePool(world);
    for (const auto& [pos, mesh] : meshWorld(world)) renderer_->setChunk(pos, mesh);
    const render::FrameInput input{
        {{-1.5, -4, 82.8}, 50, -9, 55}, world::environmentAt(0.34f), 400, 0, render::View::Color};
    const base::Image one = imageOf(input, [](RenderOptions& o) { o.msaaSamples = 1; });
    EXPECT_TRUE(matchesGolden("pool_one_sample", one));
    const Difference d = difference(one, imageOf(input, [](RenderOptions&) {}));
    EXPECT_LT(d.mean, 1.5) << "edges alone";
}

// Faces of both are coplanar: rounding must not change which one is in front.
TEST_F(Effects, GlassInWaterDoesNotFlicker) {
    world::World world = flatWorld(3);
    placePool(world);
    for (const auto& [pos, mesh] : meshWorld(world)) renderer_->setChunk(pos, mesh);
    render::FrameInput input{
        {{-1.5, -4, 82.8}, 50, -9, 55}, world::environmentAt(0.34f), 400, 0, render::View::Color};
    const auto oneSample = [](RenderOptions& o) { o.msaaSamples = 1; };
    const base::Image before = imageOf(input, oneSample);
    input.camera.position.x += 1e-4;
    EXPECT_LT(difference(before, imageOf(input, oneSample)).mean, 0.01);
}

}  // namespace
}  // namespace terrane::golden
