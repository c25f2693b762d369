// A view with too little GPU memory for the requested distance, compared to one with enough.
#include <chrono>

#include "terrane/view/camera_path.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr std::size_t kBudgetBytes = std::size_t{24} << 20;
constexpr int kRequested = 14;
constexpr glm::ivec2 kImageSize{160, 90};

// Options without overlapping quads: at equal depth the result depends on the order of drawing, and so on the
// frames before.
render::RenderOptions options() {
    render::RenderOptions options = render::plainOptions(1);
    options.tJunctions = render::TJunctions::Open;
    options.occlusionCulling = false;
    return options;
}

const render::Camera kCamera{{-1020, -60, 100}, 200, -12};

class ViewMemoryTest : public gpu::GlTest {
  protected:
    static std::unique_ptr<DrawnSession> makePlayer(std::size_t budget, int distance, bool isOnGpu) {
        return makeDrawnSession({.size = kImageSize,
                                 .viewDistance = distance,
                                 .render = options(),
                                 .memoryBudget = budget,
                                 .meshesOnGpu = isOnGpu});
    }

    static base::Image draw(DrawnSession& player, const render::Camera& camera) {
        player.renderer.draw({camera, world::environmentAt(0.4f), fogDistance(player.view->viewDistance()), 0,
                              render::View::Color});
        return player.renderer.readImage();
    }

    static int largestDifference(const base::Image& a, const base::Image& b) {
        int largest = 0;
        for (std::size_t k = 0; k < a.rgba.size(); ++k)
            largest = std::max(largest, std::abs(int{a.rgba[k]} - int{b.rgba[k]}));
        return largest;
    }

    // Channels that differ by more than one step.
    static int countOfOthers(const base::Image& a, const base::Image& b) {
        int count = 0;
        for (std::size_t k = 0; k < a.rgba.size(); ++k)
            count += std::abs(int{a.rgba[k]} - int{b.rgba[k]}) > 1 ? 1 : 0;
        return count;
    }

    // Draws frames as the window does until all is loaded. Returns the number of notices.
    static int frames(DrawnSession& player, const render::Camera& camera, int distance) {
        int notices = 0;
        for (bool isLoaded = false; !isLoaded;) {
            player.view->follow(camera, distance);
            player.view->upload(0.02);
            draw(player, camera);
            EXPECT_LE(player.renderer.memory().total(), kBudgetBytes);
            EXPECT_LE(player.renderer.peakMemory(), kBudgetBytes);
            notices += player.view->takeNotice().has_value();
            const stream::ChunkPipeline& pipeline = player.session->pipeline();
            isLoaded =
                pipeline.progress().isUpToDate() && pipeline.waitingChanges() + player.view->waiting() == 0;
        }
        return notices;
    }

    static void expectShortView(DrawnSession& player) {
        EXPECT_EQ(frames(player, kCamera, kRequested), 1);
        const int reached = player.view->viewDistance();
        EXPECT_LT(reached, kRequested);
        EXPECT_GE(reached, 4) << "most of the budget is of use";
        const base::Image image = draw(player, kCamera);
        // It stays as it is, also where the camera moves.
        EXPECT_EQ(frames(player, {{-980, -60, 100}, 30, -12}, kRequested), 0);
        EXPECT_EQ(player.view->viewDistance(), reached);
        EXPECT_EQ(frames(player, kCamera, kRequested), 0);
        // Chunks behind the fog may be others: the fog rounds to a step of the HDR image beside the sky, and
        // a step of its few bits is now and then two of the screen's.
        const base::Image again = draw(player, kCamera);
        EXPECT_LE(largestDifference(again, image), 2);
        EXPECT_LE(countOfOthers(again, image), 3);
    }
};

TEST_F(ViewMemoryTest, TheViewGetsShorterInPlaceOfHoles) {
    const auto small = makePlayer(kBudgetBytes, kRequested, false);
    expectShortView(*small);
    const int reached = small->view->viewDistance();
    const auto large = makePlayer(SIZE_MAX, reached, false);
    loadAll(*large->session, *large->view, kCamera, reached, std::chrono::steady_clock::now());
    EXPECT_EQ(large->view->viewDistance(), reached);
    EXPECT_FALSE(large->view->takeNotice());
    EXPECT_EQ(draw(*small, kCamera).rgba, draw(*large, kCamera).rgba)
        << "what is in the shorter view is all there";

    // Another distance begins anew.
    EXPECT_EQ(frames(*small, kCamera, 3), 0);
    EXPECT_EQ(small->view->viewDistance(), 3);
}

TEST_F(ViewMemoryTest, AlsoWhereTheGpuMeshes) {
    const auto small = makePlayer(2 * kBudgetBytes, kRequested, true);
    loadAll(*small->session, *small->view, kCamera, kRequested, std::chrono::steady_clock::now());
    const int reached = small->view->viewDistance();
    EXPECT_LE(small->renderer.peakMemory(), 2 * kBudgetBytes);
    const auto large = makePlayer(SIZE_MAX, reached, false);
    loadAll(*large->session, *large->view, kCamera, reached, std::chrono::steady_clock::now());
    // The smaller view keeps some chunks beyond its distance, which have all but faded into the sky: which
    // ones depends on the order they came in. A pixel is two or three steps off; a missing chunk is tens.
    EXPECT_LE(largestDifference(draw(*small, kCamera), draw(*large, kCamera)), 4);
}

TEST_F(ViewMemoryTest, LimitsOfDrawsShortenItToo) {
    constexpr int kDistance = 8;
    const auto small = makeDrawnSession({.size = kImageSize,
                                         .viewDistance = kDistance,
                                         .render = options(),
                                         .quads = {.limits = {.meshSections = 400}}});
    loadAll(*small->session, *small->view, kCamera, kDistance, std::chrono::steady_clock::now());
    const int reached = small->view->viewDistance();
    EXPECT_LT(reached, kDistance);
    EXPECT_GE(reached, 2) << "the lists are of use";
    const auto large = makePlayer(SIZE_MAX, reached, false);
    loadAll(*large->session, *large->view, kCamera, reached, std::chrono::steady_clock::now());
    EXPECT_EQ(draw(*small, kCamera).rgba, draw(*large, kCamera).rgba);
}

// The budget counts the targets too.
TEST_F(ViewMemoryTest, ALargerImageTakesMemoryFromTheWorld) {
    const auto player = makePlayer(kBudgetBytes, kRequested, false);
    frames(*player, kCamera, kRequested);
    const int before = player->view->viewDistance();
    ASSERT_TRUE(player->renderer.configure({480, 270}, options()));
    for (int k = 0; k < 3; ++k) {
        player->view->follow(kCamera, kRequested);
        player->view->upload(0.02);
        EXPECT_LE(player->renderer.memory().total(), kBudgetBytes);
    }
    loadAll(*player->session, *player->view, kCamera, kRequested, std::chrono::steady_clock::now());
    EXPECT_LE(player->renderer.memory().total(), kBudgetBytes);
    EXPECT_LE(player->view->viewDistance(), before);
    EXPECT_GE(player->view->viewDistance(), 2);
    EXPECT_GT(player->renderer.quadBytes(), 0u);
}

}  // namespace
}  // namespace terrane::view
