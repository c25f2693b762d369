#include "terrane/render/frame/render_options.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace terrane::render {
namespace {

// The thesis's settings, section 6.
TEST(RenderOptions, ThesisIsWhatItMeasuredWith) {
    const RenderOptions o = findPreset("thesis", true)->options;
    EXPECT_EQ(o.msaaSamples, 2);
    EXPECT_EQ(o.shading, Shading::Sample);
    EXPECT_TRUE(o.msaaAlphaTest && o.depthOfField && o.godRays && o.animation && o.sharpFiltering);
    EXPECT_EQ(o.shadows, ShadowReach::Near);
    EXPECT_EQ(o.shadowSize, 2048);
    EXPECT_EQ(o.occlusion, Occlusion::Off);
    EXPECT_EQ(o.transparencyLayers, 3);
    EXPECT_EQ(o.tJunctions, TJunctions::Filled);
    const GraphicsSettings all = withPreset({}, "thesis", true);
    EXPECT_EQ(all.mesh.method, mesh::MergeMethod::SquaresExt);
    EXPECT_EQ(all.mesh.meshSectionHeight, 64);
    EXPECT_EQ(all.viewDistance, 32);
    EXPECT_EQ(all.horizon, 0) << "the thesis draws chunks only";
}

TEST(RenderOptions, OtherPresetsLeaveWhatIsSeenHowFar) {
    for (const char* name : {"low", "medium", "high", "ultra", "auto"}) {
        const GraphicsSettings settings = withPreset(
            {.render = {}, .mesh = {mesh::MergeMethod::None, 8}, .viewDistance = 7, .horizon = 256}, name,
            true);
        EXPECT_EQ(settings.viewDistance, 7) << name;
        EXPECT_EQ(settings.horizon, 256) << name;
        EXPECT_EQ(settings.mesh, mesh::MeshOptions{}) << name;
    }
}

TEST(RenderOptions, UltraHasMoreThanHigh) {
    const GraphicsSettings high = withPreset({}, "high", false), ultra = withPreset({}, "ultra", false);
    EXPECT_GT(ultra.render.shadowSize, high.render.shadowSize);
    EXPECT_GT(ultra.detail, high.detail);
    RenderOptions same = ultra.render;
    same.shadowSize = high.render.shadowSize;
    EXPECT_EQ(same, high.render) << "nothing is worse";
    EXPECT_EQ(withPreset(ultra, "high", false), high) << "no detail stays behind";
}

// How draws reach the driver is a matter of the driver.
TEST(RenderOptions, PresetsKeepTheWayOfDrawing) {
    GraphicsSettings settings;
    EXPECT_EQ(withPreset(settings, "low", true).render.draw, DrawMethod::Auto);
    settings.render.draw = DrawMethod::Loop;
    for (const Preset& preset : presets())
        EXPECT_EQ(withPreset(settings, preset.name, true).render.draw, DrawMethod::Loop) << preset.name;
}

TEST(RenderOptions, LowHasNoEffects) {
    const RenderOptions o = findPreset("low", false)->options;
    EXPECT_EQ(o.msaaSamples, 1);
    EXPECT_EQ(o.shadows, ShadowReach::Off);
    EXPECT_EQ(o.occlusion, Occlusion::Off);
    EXPECT_FALSE(o.depthOfField || o.godRays || o.clouds);
    EXPECT_GT(o.transparencyLayers, 0) << "water is seen";
}

TEST(RenderOptions, AutoGoesByTheRenderer) {
    EXPECT_EQ(findPreset("auto", true), findPreset("low", true));
    EXPECT_EQ(findPreset("auto", false), findPreset("high", false));
}

TEST(RenderOptions, OtherNamesAreNone) {
    EXPECT_FALSE(findPreset("", false));
    EXPECT_FALSE(findPreset("best", false));
}

TEST(RenderOptions, APresetHasAName) {
    EXPECT_EQ(findPreset("lowest", true), nullptr);
    EXPECT_THROW(withPreset({}, "lowest", true), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::render
