// Land of tiles looks like the land of chunks that it stands for. bench_far_view does the same with twenty
// views as far as 96 chunks.
#include "bench/picture_figures.h"
#include "terrane/view/camera_path.h"
#include "tests/view/drawn_session.h"

namespace terrane::view {
namespace {

constexpr glm::ivec2 kSamenessSize{320, 180};
constexpr int kChunksSeen = 16, kChunksBeforeTiles = 5;

class FarSamenessTest : public gpu::GlTest {
  protected:
    static std::unique_ptr<DrawnSession> load(const render::Camera& camera, bool hasTiles) {
        const int near = hasTiles ? kChunksBeforeTiles : kChunksSeen;
        auto player = makeDrawnSession({.size = kSamenessSize, .viewDistance = near});
        player->view->setHorizon({hasTiles ? kChunksSeen : 0, 8});
        loadAll(*player->session, *player->view, camera, near, std::chrono::steady_clock::now());
        return player;
    }

    static bench::Pictures picturesOf(DrawnSession& player, const render::Camera& camera, float time) {
        const auto with = [&](int layers, render::View view) {
            render::RenderOptions options = render::plainOptions(1);
            options.transparencyLayers = layers;
            EXPECT_TRUE(player.renderer.configure(kSamenessSize, options));
            return player.draw({camera, world::environmentAt(time), fogDistance(kChunksSeen), 0, view});
        };
        return {with(1, render::View::Color), with(0, render::View::Color), with(0, render::View::Normal)};
    }
};

// Tiles begin closer here than the program lets them, so that there is something to see.
TEST_F(FarSamenessTest, TilesLookLikeChunks) {
    const render::Camera coast{{196, -522, 120}, 0, -12}, forest{{-1048, -108, 160}, 136, -15};
    for (const render::Camera& camera : {coast, forest}) {
        const auto chunks = load(camera, false), tiles = load(camera, true);
        for (const float time : {0.5f, 0.78f, 0.0f}) {
            const bench::PictureFigures figures =
                comparePictures(picturesOf(*chunks, camera, time), picturesOf(*tiles, camera, time), 2);
            EXPECT_LT(figures.meanDifference, 4) << time;
            EXPECT_GT(figures.meanDifference, 0) << "tiles are seen";
            EXPECT_LT(figures.percentile99, 16) << time;
            EXPECT_NEAR(figures.brightness, 1, 0.03) << time;
            EXPECT_GE(figures.waterInBoth, 0.9 * figures.waterInAny) << time;
        }
    }
}

// The statistics detect differences.
TEST(PictureFigures, TellWhatDiffers) {
    constexpr int kSide = 64;
    const auto filled = [](std::uint8_t value) {
        base::Image image{kSide, kSide, std::vector<std::uint8_t>(4 * kSide * kSide, value)};
        return image;
    };
    const bench::Pictures gray{filled(128), filled(128), filled(128)};
    const bench::PictureFigures none = comparePictures(gray, gray, 1);
    EXPECT_EQ(none.meanDifference + none.percentile99 + none.skyline + none.waterInAny, 0);
    EXPECT_EQ(none.brightness, 1);

    bench::Pictures other = gray;
    std::fill_n(other.normal.rgba.begin(), 4 * kSide * 3, std::uint8_t{0});           // three rows less
    std::fill_n(other.color.rgba.begin(), 4 * kSide * kSide / 2, std::uint8_t{188});  // half of it wet
    const bench::PictureFigures half = comparePictures(gray, other, 2);
    // sRGB 188 is 0.503 linear, 128 is 0.216.
    EXPECT_NEAR(half.meanDifference, 255 * (0.503 - 0.216) / 2, 0.2);
    EXPECT_NEAR(half.percentile99, 255 * (0.503 - 0.216), 0.4);
    EXPECT_NEAR(half.brightness, (0.503 + 0.216) / 2 / 0.216, 0.01);
    EXPECT_EQ(half.waterInBoth, 0);
    EXPECT_EQ(half.waterInAny, kSide * kSide / 2);
}

}  // namespace
}  // namespace terrane::view
