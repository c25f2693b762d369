// Frames drawn by rays show what frames drawn from quads show: in the overworld with a horizon, after flights
// and edits, and without meshes.
#include <fmt/format.h>

#include "bench/hole_finder.h"
#include "tests/render/gbuffer_compare.h"
#include "tests/support/depth.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr glm::ivec2 kFrameSize{96, 54};
constexpr int kFramesNear = 4, kFramesHorizon = 64;  // chunks

class RayFramesTest : public gpu::GlTest {
  protected:
    static std::unique_ptr<DrawnSession> makePlayer(render::SurfaceMethod method) {
        DrawnSessionOptions options{.size = kFrameSize, .viewDistance = kFramesNear};
        options.render.distanceFog = false;
        options.render.surfaces = method;
        auto player = makeDrawnSession(std::move(options));
        player->view->setHorizon({kFramesHorizon, 8});
        return player;
    }

    // The frame of a camera, so many times as large.
    static render::SeenFaces seen(DrawnSession& player, const render::Camera& camera, int times = 1) {
        EXPECT_TRUE(player.renderer.configure(times * kFrameSize, player.renderer.options()));
        loadAll(*player.session, *player.view, camera, kFramesNear, std::chrono::steady_clock::now());
        player.renderer.draw({camera, world::environmentAt(0.5f), 1e6f});
        return render::seenSurfaces(player.renderer);
    }
};

TEST_F(RayFramesTest, RaysAndQuadsShowTheSame) {
    const auto quads = makePlayer(render::SurfaceMethod::Quads),
               rays = makePlayer(render::SurfaceMethod::Rays);
    bench::ShownBlocks blocks(*quads->session);
    std::mt19937 random(3);
    const auto within = [&](int reach) { return std::uniform_int_distribution<int>(-reach, reach)(random); };
    render::FaceAgreement sum;
    for (int k = 0; k < atDepth(6, 100); ++k) {
        const world::ChunkPos pos{within(300), within(300)};
        blocks.forget();
        render::Camera camera = bench::randomCamera(blocks.whole(pos), pos, contentBlocks(), random);
        if (k % 3 == 0) {  // toward the horizon
            camera.position.z = 150;
            camera.pitch = -10;
        }
        const render::FaceAgreement found = compareFaces(seen(*quads, camera), seen(*rays, camera),
                                                         seen(*rays, camera, render::kRaysAcrossPixel));
        // Toward the horizon most faces are narrower than a pixel.
        EXPECT_LE(found.others, found.pixels / 100)
            << fmt::format("--at={},{},{} --look {},{}: {}", camera.position.x, camera.position.y,
                           camera.position.z, camera.yaw, camera.pitch, textOf(found));
        sum += found;
    }
    fmt::print("{}\n", textOf(sum));
    EXPECT_LE(sum.others, sum.pixels / 500);
    EXPECT_GT(sum.centers, sum.pixels * 98 / 100);
    EXPECT_GT(sum.shown, sum.pixels / 2);
    EXPECT_GT(sum.tiles, 0);
    // Nothing was meshed for rays.
    EXPECT_EQ(rays->renderer.quadBytes(), 0u);
    for (const stream::TaskTime& task : rays->session->taskTimes()) {
        if (std::string_view(task.name) == "mesh") {
            EXPECT_EQ(task.count, 0u);
        }
    }
}

TEST_F(RayFramesTest, AnEditIsSeenInTheNextFrame) {
    const auto rays = makePlayer(render::SurfaceMethod::Rays);
    const world::ChunkPos pos{0, 0};
    bench::ShownBlocks blocks(*rays->session);
    std::mt19937 random(8);
    const render::Camera camera = bench::randomCamera(blocks.whole(pos), pos, contentBlocks(), random);
    const render::SeenFaces before = seen(*rays, camera);
    const glm::dvec3 ahead = camera.position + 3.0 * glm::dvec3(render::lookDirection(camera));
    const world::BlockPos at{static_cast<int>(std::floor(ahead.x)), static_cast<int>(std::floor(ahead.y)),
                             static_cast<int>(std::floor(ahead.z))};
    const world::PlacedBlock placed{at, {contentBlock("stone"), 0, nullptr}};
    rays->session->setBlocks(std::span(&placed, 1));
    rays->view->follow(camera, kFramesNear);
    rays->view->upload(0);
    rays->renderer.draw({camera, world::environmentAt(0.5f), 1e6f});
    const render::SeenFaces after = render::seenSurfaces(rays->renderer);
    const auto middle = static_cast<std::size_t>(after.size.x / 2 + after.size.x * (after.size.y / 2));
    EXPECT_NE(before.distance[middle], after.distance[middle]);
    EXPECT_NEAR(after.distance[middle], 3, 1.2);
}

// Renderers change during play: chunks and tiles come again.
TEST_F(RayFramesTest, RaysAndQuadsTakeTurns) {
    const auto player = makePlayer(render::SurfaceMethod::Quads);
    const render::Camera camera{{8, 8, 140}, 30, -20};
    const render::SeenFaces quads = seen(*player, camera);
    render::RenderOptions options = player->renderer.options();
    for (int turn = 0; turn < 2; ++turn) {
        options.surfaces = render::SurfaceMethod::Rays;
        ASSERT_TRUE(player->renderer.configure(kFrameSize, options));
        const render::SeenFaces rays = seen(*player, camera);
        const render::FaceAgreement found =
            compareFaces(quads, rays, seen(*player, camera, render::kRaysAcrossPixel));
        EXPECT_LE(found.others, found.pixels / 200) << textOf(found);
        options.surfaces = render::SurfaceMethod::Quads;
        ASSERT_TRUE(player->renderer.configure(kFrameSize, options));
        EXPECT_EQ(seen(*player, camera).distance, quads.distance);
    }
}

}  // namespace
}  // namespace terrane::view
