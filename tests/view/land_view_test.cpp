// The light of land from the generator to the image.
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

constexpr render::Camera kLooksBack{.position = {8, 8, 100}, .yaw = 180, .pitch = -12, .fieldOfView = 60};

// Of the ground some 60 blocks away, where the shadow map has ended.
double groundBrightness(bool hasWall, float elevation, int shadowSize = 1024) {
    DrawnSessionOptions options{.makeGraph = [=](int level) { return plain(level, hasWall); }};
    options.render.shadowSize = shadowSize;
    const auto drawn = makeDrawnSession(std::move(options));
    EXPECT_EQ(drawn->view->missingClipmapTiles(), 0u) << "not asked for yet";
    EXPECT_TRUE(drawn->renderer.hasLand());
    loadAll(*drawn->session, *drawn->view, kLooksBack, 4, std::chrono::steady_clock::now());
    EXPECT_EQ(drawn->view->missingClipmapTiles(), 0u);
    world::Environment light = world::environmentAt(0.5f);
    light.lightDirection = {std::cos(elevation), 0, std::sin(elevation)};
    const base::Image image = drawn->draw({kLooksBack, light, 400, 0, render::View::Color});
    double sum = 0;
    for (int x = 30; x < 66; ++x) sum += image.rgba[static_cast<std::size_t>(4 * (x + 37 * image.width) + 1)];
    return sum / 36;
}

TEST_F(LandViewTest, AWallBeyondTheShadowMapDarkensTheGround) {
    EXPECT_LT(groundBrightness(true, 0.4f), 0.9 * groundBrightness(false, 0.4f));
    EXPECT_NEAR(groundBrightness(true, 1.2f), groundBrightness(false, 1.2f), 12) << "the sun is above it";
    EXPECT_NEAR(groundBrightness(true, 0.4f, 0), groundBrightness(false, 0.4f, 0), 1) << "shadows are off";
}

}  // namespace
}  // namespace terrane::view
