// Light of the land, from the generator to the image.
#include "terrane/view/land_view.h"

#include <cmath>

#include "tests/gpu/gl_fixture.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

class LandViewTest : public gpu::GlTest {};

// Flat land of stone, with a wall beyond x = 160.
base::Result<gen::GeneratorGraph> plain(int level, bool hasWall) {
    gen::GeneratorBuilder g("plain", contentBlocks(), level);
    g.pass3D("ground", [=](gen::Pass& p) {
        const auto stone = p.block("stone"), air = p.block("air");
        const auto low = select(p.z() <= 80, stone, air);
        p.setBlock(hasWall ? select(p.x() > 160, select(p.z() <= 220, stone, air), low) : low);
    });
    return g.finish();
}

constexpr render::Camera kLooksBack{.position = {8, 8, 200}, .yaw = 225, .pitch = -4.6f, .fieldOfView = 20};

// Brightness of the ground some 1,500 blocks away and 1,060 beside the direction of the light, beyond the
// shadow maps.
double groundBrightness(bool hasWall, float elevation,
                        render::ShadowReach shadows = render::ShadowReach::Horizon) {
    DrawnSessionOptions options{.makeGraph = [=](int level) { return plain(level, hasWall); }};
    options.render.shadows = shadows;
    options.render.distanceFog = false;
    const auto drawn = makeDrawnSession(std::move(options));
    EXPECT_EQ(drawn->view->missingClipmapTiles(), 0u) << "not asked for yet";
    EXPECT_TRUE(drawn->renderer.hasLand());
    drawn->view->setHorizon({128, 8});
    loadAll(*drawn->session, *drawn->view, kLooksBack, 4, std::chrono::steady_clock::now());
    EXPECT_EQ(drawn->view->missingClipmapTiles(), 0u);
    world::Environment light = world::environmentAt(0.5f);
    light.lightDirection = {std::cos(elevation), 0, std::sin(elevation)};
    light.ambientColor *= 0.1f;  // so that direct light tells
    const render::FrameInput input{kLooksBack, light, 1e5f, 0, render::View::Color};
    const base::Image image = drawn->draw(input);
    // A frame computes a level at most, but all are there after loadAll().
    for (int frame = 0; frame < 8; ++frame) drawn->renderer.draw(input);
    EXPECT_EQ(drawn->draw(input).rgba, image.rgba) << "levels came later";
    double sum = 0;
    for (int x = 30; x < 66; ++x) sum += image.rgba[static_cast<std::size_t>(4 * (x + 32 * image.width) + 1)];
    return sum / 36;
}

TEST_F(LandViewTest, AWallBeyondTheShadowMapDarkensTheGround) {
    constexpr float kLow = 0.09f, kAboveTheWall = 1.2f;
    EXPECT_LT(groundBrightness(true, kLow), 0.9 * groundBrightness(false, kLow));
    EXPECT_NEAR(groundBrightness(true, kAboveTheWall), groundBrightness(false, kAboveTheWall), 12);
    for (const render::ShadowReach shadows : {render::ShadowReach::Off, render::ShadowReach::Far})
        EXPECT_NEAR(groundBrightness(true, kLow, shadows), groundBrightness(false, kLow, shadows), 1);
}

}  // namespace
}  // namespace terrane::view
