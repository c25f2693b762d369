// A tint from the generator to the image.
#include "terrane/view/land_view.h"

#include <cmath>

#include "tests/gpu/gl_fixture.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

class TintViewTest : public gpu::GlTest {};

// Flat land; grass is red where x < 0, and green elsewhere.
base::Result<gen::GeneratorGraph> halves(int level, bool hasTint) {
    gen::GeneratorBuilder g("halves", contentBlocks(), level);
    if (hasTint) {
        const auto colors = g.field<gen::Int>("colors");
        g.pass2D("colors", [&](gen::Pass& p) {
            p.set(colors,
                  select(p.x() < 0, gen::packColor(0.8f, 0.2f, 0.2f), gen::packColor(0.2f, 0.6f, 0.2f)));
        });
        g.tint(colors);
    }
    g.pass3D("ground",
             [](gen::Pass& p) { p.setBlock(select(p.z() <= 80, p.block("grass"), p.block("air"))); });
    return g.finish();
}

std::unique_ptr<DrawnSession> sessionOf(bool hasTint) {
    return makeDrawnSession({.makeGraph = [=](int level) { return halves(level, hasTint); }});
}

constexpr render::Camera kDown{.position = {0, 8, 110}, .yaw = 90, .pitch = -89, .fieldOfView = 50};

base::Image imageOf(DrawnSession& drawn) {
    loadAll(*drawn.session, *drawn.view, kDown, 4, std::chrono::steady_clock::now());
    return drawn.draw({kDown, world::environmentAt(0.5f), 400, 0, render::View::Color});
}

TEST_F(TintViewTest, GrassHasTheColorOfItsPlace) {
    const auto drawn = sessionOf(true);
    EXPECT_EQ(drawn->view->missingClipmapTiles(), 0u) << "not asked for yet";
    const base::Image image = imageOf(*drawn);
    EXPECT_TRUE(drawn->renderer.hasTint());
    EXPECT_EQ(drawn->view->missingClipmapTiles(), 0u);
    const auto at = [&](int x, int channel) {
        return int{image.rgba[static_cast<std::size_t>(4 * (x + 32 * image.width) + channel)]};
    };
    EXPECT_GT(at(10, 0), at(10, 1) + 50) << "x < 0 is on the left";
    EXPECT_GT(at(86, 1), at(86, 0) + 50);
}

// The next world uses the same renderer.
TEST_F(TintViewTest, AnotherWorldForgetsIt) {
    const auto first = sessionOf(true), second = sessionOf(false);
    EXPECT_FALSE(second->renderer.hasTint());
    EXPECT_TRUE(first->renderer.hasTint());
    first->view.reset();
    first->renderer.clearChunks();
    WorldView view(*second->session, first->renderer);
    EXPECT_FALSE(first->renderer.hasTint());
}

}  // namespace
}  // namespace terrane::view
