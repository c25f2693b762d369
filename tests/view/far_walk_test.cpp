// Walking over the borders between chunks and tiles shows no more change than the walk itself.
#include <cmath>
#include <cstdlib>

#include "terrane/view/camera_path.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr glm::ivec2 kWalkSize{240, 136};
constexpr int kTilesFrom = 5, kAllChunks = 16;

class FarWalkTest : public gpu::GlTest {
  protected:
    // As far as kAllChunks; chunks only, or tiles from kTilesFrom on.
    static std::unique_ptr<DrawnSession> open(bool hasTiles, int near) {
        auto player = makeDrawnSession({.size = kWalkSize, .viewDistance = near});
        player->view->setHorizon({hasTiles ? kAllChunks : 0, 8});
        return player;
    }

    static base::Image imageAt(DrawnSession& player, const render::Camera& camera, int viewDistance) {
        loadAll(*player.session, *player.view, camera, viewDistance, std::chrono::steady_clock::now());
        return player.draw(
            {camera, world::environmentAt(0.4f), fogDistance(kAllChunks), 0, render::View::Color});
    }

    // The share of pixels that look different.
    static double change(const base::Image& a, const base::Image& b) {
        int count = 0;
        for (std::size_t k = 0; k < a.rgba.size(); k += 4) {
            int sum = 0;
            for (std::size_t c = 0; c < 3; ++c) sum += std::abs(a.rgba[k + c] - b.rgba[k + c]);
            count += sum > 30;
        }
        return 4.0 * count / static_cast<double>(a.rgba.size());
    }

    struct Changes {
        double most = 0, mean = 0;
    };

    // Changes between consecutive images on a walk of this many steps.
    static Changes changesOnWalk(bool hasTiles, int steps, const glm::dvec3& step) {
        const int near = hasTiles ? kTilesFrom : kAllChunks;
        const auto player = open(hasTiles, near);
        render::Camera camera{{-1048, -108, 170}, 40, -20};
        base::Image before = imageAt(*player, camera, near);
        Changes changes;
        for (int n = 0; n < steps; ++n) {
            camera.position += step;
            const base::Image now = imageAt(*player, camera, near);
            changes.most = std::max(changes.most, change(before, now));
            changes.mean += change(before, now) / steps;
            before = now;
        }
        EXPECT_GT(changes.mean, 0) << "the walk is seen";
        return changes;
    }
};

TEST_F(FarWalkTest, ABorderIsCrossedUnseen) {
    const glm::dvec3 step(-0.5, 0.35, 0);  // two borders of chunks in 40 steps
    const Changes tiles = changesOnWalk(true, 40, step);
    EXPECT_LE(tiles.most, changesOnWalk(false, 40, step).most);
    EXPECT_LT(tiles.most, 1.25 * tiles.mean) << "where tiles give way to chunks nothing pops up";
}

// Nothing flickers: tiles and chunks lie nowhere in the same plane.
TEST_F(FarWalkTest, AHairsBreadthChangesNothing) {
    const glm::dvec3 step(0.01, 0.01, 0);
    EXPECT_LE(changesOnWalk(true, 8, step).most, changesOnWalk(false, 8, step).most + 0.001);
}

}  // namespace
}  // namespace terrane::view
