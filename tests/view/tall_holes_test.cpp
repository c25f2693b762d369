// Tall worlds have no holes: each pixel is as far away as the block that a ray through the world meets.
#include "bench/hole_finder.h"
#include "bench/tall_land.h"
#include "terrane/view/camera_path.h"
#include "tests/support/depth.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr glm::ivec2 kHolesSize{160, 90};
constexpr int kHolesNear = 4;  // chunks

class TallHolesTest : public gpu::GlTest {
  protected:
    static std::unique_ptr<DrawnSession> makeSession(gen::LevelGenerators::MakeGraph makeGraph,
                                                     world::Heights heights, int horizon) {
        DrawnSessionOptions options{.size = kHolesSize,
                                    .viewDistance = kHolesNear,
                                    .makeGraph = std::move(makeGraph),
                                    .heights = heights};
        options.render.distanceFog = false;
        auto player = makeDrawnSession(std::move(options));
        player->view->setHorizon({horizon, 8});
        return player;
    }
    static void load(DrawnSession& player, const render::Camera& camera) {
        loadAll(*player.session, *player.view, camera, kHolesNear, std::chrono::steady_clock::now());
    }
    static std::string describe(const render::Camera& camera) {
        return fmt::format("--at={},{},{} --look {},{}", camera.position.x, camera.position.y,
                           camera.position.z, camera.yaw, camera.pitch);
    }
};

// On the ground, in caves, beside cliffs, high above; bench_holes looks from a thousand places.
TEST_F(TallHolesTest, NoCameraSeesAHole) {
    const int places = atDepth(3, 20), cameras = atDepth(5, 20);
    std::mt19937 random(5);
    const auto within = [&](int reach) { return std::uniform_int_distribution<int>(-reach, reach)(random); };
    const auto player = makeSession(bench::recordTallLand(contentBlocks()), bench::kTallHeights, 128);
    bench::ShownBlocks blocks(*player->session);
    bench::HoleCount sum;
    for (int place = 0; place < places; ++place) {
        const world::ChunkPos middle{within(4000), within(4000)};
        blocks.forget();
        for (int k = 0; k < cameras; ++k) {
            const world::ChunkPos pos = world::offsetBy(middle, within(2), within(2));
            const render::Camera camera =
                bench::randomCamera(blocks.whole(pos), pos, contentBlocks(), random);
            load(*player, camera);
            const bench::HoleCount found = bench::findHoles(player->renderer, blocks, camera);
            EXPECT_EQ(found.holes, 0u) << describe(camera);
            EXPECT_EQ(found.walls, 0u) << describe(camera);
            sum += found;
        }
    }
    EXPECT_GT(sum.pixels, static_cast<std::size_t>(places * cameras * 4000)) << "most of them see ground";
}

// The test above would find them: a chunk, a tile or a part of a mesh that is missing is a hole, and what is
// not in the world is a wall.
TEST_F(TallHolesTest, WhatIsMissingIsAHole) {
    const auto player = makeSession(bench::recordTallLand(contentBlocks()), bench::kTallHeights, 128);
    const render::Camera camera{{8.5, 8.5, 700}, 40, -50};
    load(*player, camera);
    bench::ShownBlocks blocks(*player->session);
    EXPECT_EQ(bench::findHoles(player->renderer, blocks, camera).where.size(), 0u);
    int seen = 0, number = 0;
    for (const auto& [pos, record] : player->session->tiles().table().records) {
        if (!record.isShown || pos.level > 1 || ++number % 64 != 0) continue;
        player->renderer.setShown(pos, false);
        const bench::HoleCount found = bench::findHoles(player->renderer, blocks, camera);
        player->renderer.setShown(pos, true);
        seen += found.holes > 20;
        EXPECT_EQ(found.walls, 0u);
    }
    EXPECT_GT(seen, 0);
}

// Steps of mesh::kOpenSections at borders of chunks, of tiles and between.
TEST_F(TallHolesTest, CliffsAreWholeFromFarAway) {
    constexpr world::Heights kHigh{-64, 1536};
    const auto cliffs = [](int level) {
        gen::GeneratorBuilder g("cliffs", contentBlocks(), level);
        g.declareHeights({-64, 1536});
        g.pass3D("ground", [](gen::Pass& p) {
            const gen::Bool isHigh = (((p.x() >> 8) + (p.y() >> 8)) & 1) == 0;
            p.setBlock(select(p.z() < select(isHigh, gen::Int(310), gen::Int(60)), p.block("stone"),
                              p.block("air")));
        });
        return g.finish();
    };
    const auto player = makeSession(cliffs, kHigh, 128);
    bench::ShownBlocks blocks(*player->session);
    for (int k = 0; k < atDepth(8, 60); ++k) {
        const double z = k % 3 == 0 ? 312.5 : k % 3 == 1 ? 62.5 : 900.5;
        const render::Camera camera{{k % 3 == 1 ? 300.5 : 8.5, 8.5 + 16 * k, z},
                                    static_cast<float>(40 * k % 360),
                                    k % 3 == 1 ? 20.0f : -35.0f};
        load(*player, camera);
        const bench::HoleCount found = bench::findHoles(player->renderer, blocks, camera);
        EXPECT_EQ(found.holes, 0u) << describe(camera);
        EXPECT_EQ(found.walls, 0u) << describe(camera);
    }
}

}  // namespace
}  // namespace terrane::view
