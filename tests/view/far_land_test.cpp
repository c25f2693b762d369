// Land to the horizon with known content: flat, or repeating every 256 blocks.
#include <algorithm>

#include "terrane/view/camera_path.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr glm::ivec2 kLandSize{160, 96};
constexpr int kLandNear = 4;

// Terraces of sand and stone, with water between them.
base::Result<gen::GeneratorGraph> terraces(int level) {
    gen::GeneratorBuilder g("terraces", contentBlocks(), level);
    g.pass3D("ground", [](gen::Pass& p) {
        const gen::Int top = ((p.x() >> 5) & 7) * 4 + ((p.y() >> 6) & 3) * 3 + 50;
        const gen::Block ground = select((p.x() & 64) == 0, p.block("sand"), p.block("stone"));
        const gen::Block open = select(p.z() < 60, p.block("water"), p.block("air"));
        p.setBlock(select(p.z() < top, ground, open));
    });
    return g.finish();
}

class FarLandTest : public gpu::GlTest {
  protected:
    static base::Image imageOf(const gen::LevelGenerators::MakeGraph& land, const render::Camera& camera,
                               int horizon, bool hasFog = true) {
        DrawnSessionOptions options{.size = kLandSize, .viewDistance = kLandNear, .makeGraph = land};
        options.render.distanceFog = hasFog;
        const auto player = makeDrawnSession(std::move(options));
        player->view->setHorizon({horizon, 8});
        loadAll(*player->session, *player->view, camera, kLandNear, std::chrono::steady_clock::now());
        return player->draw({camera, world::environmentAt(0.4f), 1e6f, 0, render::View::Color});
    }
};

TEST_F(FarLandTest, ItIsTheSameFarAway) {
    const auto imageAt = [](double x, double y) {
        return imageOf(terraces, {{x + 8.5, y + 8.25, 110}, 40, -12}, 512);
    };
    constexpr double kFarAway = 1 << 30;
    const base::Image near = imageAt(0, 0);
    for (const double far : {kFarAway, -kFarAway}) {
        const base::Image there = imageAt(far, -far);
        for (std::size_t k = 0; k < near.rgba.size(); ++k) ASSERT_NEAR(near.rgba[k], there.rgba[k], 2) << far;
    }
}

base::Result<gen::GeneratorGraph> plain(int level) {
    return gen::makeGenerator("flat", contentBlocks(), level);
}

// Flat land shows only tops: tiles have sides under all of their border, which stay hidden.
TEST_F(FarLandTest, FlatLandHasNoLattice) {
    const auto player = makeDrawnSession({.size = kLandSize, .viewDistance = kLandNear, .makeGraph = plain});
    player->view->setHorizon({512, 8});
    int dots = 0, tops = 0;
    for (const double height : {120, 300, 1000, 4000}) {
        for (int n = 0; n < 12; ++n) {
            const render::Camera camera{
                {8, 8, height}, 33.0f * static_cast<float>(n), -10.0f - 10 * static_cast<float>(n % 9)};
            loadAll(*player->session, *player->view, camera, kLandNear, std::chrono::steady_clock::now());
            const base::Image normals =
                player->draw({camera, world::environmentAt(0.4f), 1e6f, 0, render::View::Normal});
            for (std::size_t k = 0; k < normals.rgba.size(); k += 4) {
                const bool isTop = normals.rgba[k + 2] > 250;
                tops += isTop;
                dots += !isTop && normals.rgba[k] + normals.rgba[k + 1] + normals.rgba[k + 2] > 0;
            }
        }
    }
    EXPECT_GT(tops, 300'000);
    EXPECT_LE(dots, 3);
}

// From so far above that a block is much smaller than a pixel, it has one color. (Through air, which is
// thicker toward the corners, it would not.)
TEST_F(FarLandTest, FlatLandHasOneColor) {
    const base::Image image = imageOf(plain, {{8, 8, 4000}, 30, -90}, 512, false);
    for (std::size_t c = 0; c < 3; ++c) {
        int low = 255, high = 0;
        for (std::size_t k = c; k < image.rgba.size(); k += 4) {
            low = std::min<int>(low, image.rgba[k]);
            high = std::max<int>(high, image.rgba[k]);
        }
        EXPECT_GT(low, 0);
        EXPECT_LE(high - low, 2);
    }
}

}  // namespace
}  // namespace terrane::view
