// Shadows lie still in the world while the camera and the sun move a little.
#include "tests/render/sunlit_fixture.h"

namespace terrane::render {
namespace {

constexpr glm::ivec2 kTopView{160, 128};
constexpr int kPixelsABlock = 4, kTop = 81;

class ShadowCrawlTest : public SunlitTest {
  protected:
    // Posts beside the view throw shadows across it. `x`: of the middle.
    void showPosts(int x) {
        std::vector<StoneBox> boxes = {{{{x - 64, -64, kTop - 1}, {x + 63, 63, kTop - 1}}}};
        for (int post = x - 40; post < x + 40; post += 8)
            boxes.push_back({{{post, 26, kTop}, {post + 1, 27, kTop + 39}}});
        const int chunk = x / world::kChunkSize;
        show(stoneWorld({chunk - 4, -4}, {chunk + 3, 3}, boxes));
    }
    // Straight down from `height` blocks, +x to the right: kPixelsABlock on the ground.
    static Camera above(double x, double height) {
        const double half = 0.5 * kTopView.y / kPixelsABlock;
        return {{x, 0, kTop + height}, 90, -90, static_cast<float>(2 * 57.29578 * std::atan(half / height))};
    }
    // Pixels that differ by more than `most` where `later` is `blocks` farther in +x.
    static int different(const base::Image& before, const base::Image& later, int blocks, int most) {
        int count = 0;
        const int shift = kPixelsABlock * blocks;
        for (int y = 0; y < kTopView.y; ++y)
            for (int x = 0; x + shift < kTopView.x; ++x)
                count += std::abs(pixel(before, x + shift, y)[1] - pixel(later, x, y)[1]) > most;
        return count;
    }
};

// Heights in the first, second and third cascade. Two steps: noise of one step differs between pixels.
constexpr double kHeights[] = {32, 128, 512};
constexpr int kTopPixels = kTopView.x * kTopView.y;

TEST_F(ShadowCrawlTest, StandStillUnderAMovingCamera) {
    showPosts(520);
    for (const bool isSoft : {false, true}) {
        configure(ShadowReach::Far, isSoft, 2048, kTopView);
        const world::Environment sun = sunAt(towardSun(90, 35));
        for (const double height : kHeights) {
            const base::Image first = drawUnder(above(520.5, height), sun);
            EXPECT_GT(different(first, drawUnder(above(520.5, height), sunAt({0, 0, 1})), 0, 8),
                      kTopPixels / 20)
                << "shadows can be seen";
            for (const int blocks : {1, 3, 6}) {
                const base::Image moved = drawUnder(above(520.5 + blocks, height), sun);
                EXPECT_LE(different(first, moved, blocks, 2), kTopPixels / 1000) << height << " " << blocks;
            }
            drawUnder(above(520.51, height), sun);
            EXPECT_EQ(drawUnder(above(520.5, height), sun).rgba, first.rgba) << "the camera is back";
        }
    }
}

// The maps of another anchor have their texels at other places: edges move by less than one.
TEST_F(ShadowCrawlTest, OnlyEdgesChangeWithTheAnchor) {
    showPosts(1024);
    configure(ShadowReach::Far, false, 2048, kTopView);
    const world::Environment sun = sunAt(towardSun(90, 35));
    const base::Image before = drawUnder(above(1023.5, 32), sun), after = drawUnder(above(1024.5, 32), sun);
    EXPECT_LE(different(before, after, 1, 2), kTopPixels / 20);
    EXPECT_LE(different(before, after, 1, 60), kTopPixels / 200);
}

// Less than a step of the light changes brightness alone.
TEST_F(ShadowCrawlTest, StandStillUnderASunThatMovesLessThanAStep) {
    showPosts(520);
    const glm::vec3 step(glm::transpose(shadowPlane({32, 0}, towardSun(90, 35)).toLight)[2]);
    for (const bool isSoft : {false, true}) {
        configure(ShadowReach::Far, isSoft, 2048, kTopView);
        for (const double height : kHeights) {
            const base::Image first = drawUnder(above(520.5, height), sunAt(step));
            for (const glm::vec3 way :
                 {glm::vec3(1e-3f, 0, 0), glm::vec3(0, 0, 1e-3f), glm::vec3(-1e-3f, 0, 1e-3f)})
                EXPECT_LE(different(first, drawUnder(above(520.5, height), sunAt(step + way)), 0, 2),
                          kTopPixels / 1000)
                    << height;
        }
    }
}

}  // namespace
}  // namespace terrane::render
