// Tall worlds have no holes: each pixel is as far away as the block that a ray through the world meets.
#include <cmath>
#include <set>

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
    // The chunk or tile that is shown at a place.
    static world::ChunkPos shownAt(const game::Session& session, const glm::dvec3& at) {
        const world::BlockPos block{static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)),
                                    0};
        const auto& records = session.tiles().table().records;
        world::ChunkPos pos = world::chunkOf(block);
        while (!records.contains(pos) || !records.at(pos).isShown) pos = stream::parentOf(pos);
        return pos;
    }
    static std::string describe(const render::Camera& camera) {
        return fmt::format("--at={},{},{} --look {},{}", camera.position.x, camera.position.y,
                           camera.position.z, camera.yaw, camera.pitch);
    }
};

// On the ground, in caves, beside cliffs, high above; bench_holes looks from a thousand places.
TEST_F(TallHolesTest, NoCameraSeesAHole) {
    const int places = atDepth(1, 20), cameras = atDepth(5, 20);
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

// The test above would find them: a chunk or tile in the middle of the image that is missing is a hole. (Of
// one behind a crest, only a line of pixels is seen, which edges hide.)
TEST_F(TallHolesTest, WhatIsMissingIsAHole) {
    const auto player = makeSession(bench::recordTallLand(contentBlocks()), bench::kTallHeights, 128);
    bench::ShownBlocks blocks(*player->session);
    render::Camera camera{{8.5, 8.5, 256.0}};
    camera.pitch = -15;
    load(*player, camera);
    std::set<int> levels;
    for (const float yaw : {10.0f, 100.0f, 280.0f}) {
        camera.yaw = yaw;
        const glm::dvec3 look = render::lookDirection(camera);
        const double distance = blocks.cast(camera.position, look, 1e4).ground;
        const world::ChunkPos shown = shownAt(*player->session, camera.position + look * (distance + 0.01));
        levels.insert(shown.level);
        EXPECT_EQ(bench::findHoles(player->renderer, blocks, camera).where.size(), 0u) << yaw;
        player->renderer.setShown(shown, false);
        const bench::HoleCount found = bench::findHoles(player->renderer, blocks, camera);
        player->renderer.setShown(shown, true);
        EXPECT_GT(found.holes, 200u) << yaw << " at level " << int{shown.level};
        EXPECT_EQ(found.walls, 0u) << yaw;
    }
    EXPECT_EQ(levels, (std::set<int>{0, 1, 3}));
}

// Steps as high as the world at borders of chunks, of tiles and between.
TEST_F(TallHolesTest, CliffsAreWholeFromFarAway) {
    constexpr world::Heights kHigh{-64, 1536};
    static constexpr int kHighLand = 1310, kLowLand = 60;
    const auto cliffs = [](int level) {
        gen::GeneratorBuilder g("cliffs", contentBlocks(), level);
        g.declareHeights({-64, 1536});
        g.pass3D("ground", [](gen::Pass& p) {
            const gen::Bool isHigh = (((p.x() >> 8) + (p.y() >> 8)) & 1) == 0;
            p.setBlock(select(p.z() < select(isHigh, gen::Int(kHighLand), gen::Int(kLowLand)),
                              p.block("stone"), p.block("air")));
        });
        return g.finish();
    };
    const auto player = makeSession(cliffs, kHigh, 128);
    bench::ShownBlocks blocks(*player->session);
    for (int k = 0; k < atDepth(6, 60); ++k) {
        const bool isHigh = k % 3 == 0;
        const int y = 8 + 16 * k;
        const double x = (((y >> 8) & 1) == 0) == isHigh ? 8.5 : 300.5;
        const double z = isHigh ? kHighLand + 2.5 : k % 3 == 1 ? kLowLand + 2.5 : 900.5;
        const render::Camera camera{
            {x, y + 0.5, z}, static_cast<float>(40 * k % 360), k % 3 == 1 ? 20.0f : -35.0f};
        load(*player, camera);
        const bench::HoleCount found = bench::findHoles(player->renderer, blocks, camera);
        EXPECT_EQ(found.holes, 0u) << describe(camera);
        EXPECT_EQ(found.walls, 0u) << describe(camera);
    }
}

}  // namespace
}  // namespace terrane::view
