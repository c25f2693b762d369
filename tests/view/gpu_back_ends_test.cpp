// A session with generation, light and meshes on the GPU, compared to one with workers: the same edits, views
// and images.
#include "terrane/view/gpu_back_ends.h"

#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr int kViewDistance = 2;
constexpr glm::ivec2 kSize{160, 90};

class GpuBackEndsTest : public gpu::GlTest {
  protected:
    static std::unique_ptr<DrawnSession> makePlayer(bool isOnGpu) {
        return makeDrawnSession({.size = kSize,
                                 .viewDistance = kViewDistance,
                                 .generatesOnGpu = isOnGpu,
                                 .meshesOnGpu = isOnGpu});
    }

    static base::Image imageOf(DrawnSession& player, const render::Camera& camera) {
        loadAll(*player.session, *player.view, camera, kViewDistance, std::chrono::steady_clock::now());
        return player.draw({camera, world::environmentAt(0.4f), 32, 0, render::View::Color});
    }
};

TEST_F(GpuBackEndsTest, PlayingShowsTheSame) {
    const auto onCpu = makePlayer(false), onGpu = makePlayer(true);
    const std::vector<render::Camera> cameras = {{{-1020, -60, 92}, 200, -12}, {{-990, -50, 95}, 30, -20}};
    std::optional<base::Image> before;
    for (const render::Camera& camera : cameras) {
        for (int round = 0; round < 2; ++round) {
            const base::Image expected = imageOf(*onCpu, camera);
            EXPECT_EQ(imageOf(*onGpu, camera).rgba, expected.rgba) << "round " << round;
            if (before) {
                EXPECT_NE(expected.rgba, before->rgba) << "an edit, or another view";
            }
            before = expected;
            // A lamp and a wall in front of the camera, and a hole in the ground.
            const glm::dvec3 ahead = camera.position + 6.0 * glm::dvec3(render::lookDirection(camera));
            const world::BlockPos at{static_cast<int>(ahead.x), static_cast<int>(ahead.y),
                                     static_cast<int>(ahead.z)};
            std::vector<game::EditCommand> commands;
            for (int k = 0; k < 5; ++k) {
                commands.push_back({game::kNoPlayer,
                                    {at.x + k - 2, at.y, at.z},
                                    world::SetBlock{contentBlock(k == 2 ? "lamp_red" : "stone")},
                                    {}});
                commands.push_back(
                    {game::kNoPlayer, {at.x, at.y + k - 2, at.z - 6}, world::SetBlock{world::kAir}, {}});
            }
            EXPECT_EQ(onCpu->session->edit(commands), onGpu->session->edit(commands));
        }
    }
}

}  // namespace
}  // namespace terrane::view
