#include "terrane/render/render_options.h"

#include <gtest/gtest.h>

namespace terrane::render {
namespace {

// The thesis's settings, section 6.
TEST(RenderOptions, ThesisIsWhatItMeasuredWith) {
    const RenderOptions o = findPreset("thesis", true).value();
    EXPECT_EQ(o.msaaSamples, 2);
    EXPECT_EQ(o.shading, Shading::Sample);
    EXPECT_TRUE(o.msaaAlphaTest && o.depthOfField && o.godRays && o.animation && o.sharpFiltering);
    EXPECT_EQ(o.shadowSize, 2048);
    EXPECT_EQ(o.occlusion, Occlusion::Off);
    EXPECT_EQ(o.transparencyLayers, 3);
    EXPECT_EQ(o.tJunctions, TJunctions::Covered);
    EXPECT_EQ(o, RenderOptions{});
}

TEST(RenderOptions, LowHasNoEffects) {
    const RenderOptions o = findPreset("low", false).value();
    EXPECT_EQ(o.msaaSamples, 1);
    EXPECT_EQ(o.shadowSize, 0);
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
    EXPECT_FALSE(findPreset("ultra", false));
}

}  // namespace
}  // namespace terrane::render
