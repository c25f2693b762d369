// Images that are drawn at another size than they are shown: RenderOptions::renderScale.
#include "tests/render/sunlit_fixture.h"

namespace terrane::render {
namespace {

constexpr glm::ivec2 kShown{160, 96};

class ResizeTest : public SunlitTest {
  protected:
    void SetUp() override {
        SunlitTest::SetUp();
        if (IsSkipped()) return;
        world::World world = golden::flatWorld(4);
        golden::placeGallery(world);
        show(world);
    }

    base::Image drawAt(glm::ivec2 size, int scale, Upscaling upscaling = Upscaling::Linear,
                       View view = View::Color) {
        RenderOptions options = findPreset("low", true)->options;
        options.msaaSamples = samples_;
        options.renderScale = scale;
        options.upscaling = upscaling;
        EXPECT_TRUE(renderer_->configure(size, options));
        EXPECT_EQ(renderer_->size(), size);
        return draw({{{-10, 6, 92}, 10, -25}, world::environmentAt(0.5f), 90, 0, view});
    }

    static int worstDifference(const base::Image& a, const base::Image& b) {
        EXPECT_EQ(a.rgba.size(), b.rgba.size());
        int worst = 0;
        for (std::size_t k = 0; k < std::min(a.rgba.size(), b.rgba.size()); ++k)
            worst = std::max(worst, std::abs(int{a.rgba[k]} - int{b.rgba[k]}));
        return worst;
    }

    // The mean distance from an image, in steps of a color.
    static double meanDifference(const base::Image& a, const base::Image& b) {
        double sum = 0;
        for (std::size_t k = 0; k < a.rgba.size(); ++k) sum += std::abs(int{a.rgba[k]} - int{b.rgba[k]});
        return sum / static_cast<double>(a.rgba.size());
    }

    int samples_ = 1;  // a pixel
};

TEST_F(ResizeTest, SquarePixelsAreThoseOfTheSmallerImage) {
    const base::Image small = drawAt(kShown / 2, 100);
    for (const View view : {View::Color, View::Depth}) {
        const base::Image smaller = drawAt(kShown / 2, 100, Upscaling::Nearest, view);
        const base::Image shown = drawAt(kShown, 50, Upscaling::Nearest, view);
        for (int y = 0; y < kShown.y; ++y)
            for (int x = 0; x < kShown.x; ++x) ASSERT_EQ(pixel(shown, x, y), pixel(smaller, x / 2, y / 2));
    }
}

TEST_F(ResizeTest, ALargerImageIsShownAsItsMean) {
    for (const int factor : {2, 4}) {
        const base::Image large = drawAt(factor * kShown, 100), shown = drawAt(kShown, 100 * factor);
        int worst = 0;
        for (int y = 0; y < kShown.y; ++y) {
            for (int x = 0; x < kShown.x; ++x) {
                glm::ivec3 sum(0);
                for (int k = 0; k < factor * factor; ++k) {
                    const Color c = pixel(large, factor * x + k % factor, factor * y + k / factor);
                    sum += glm::ivec3(c[0], c[1], c[2]);
                }
                sum += factor * factor / 2;
                const Color is = pixel(shown, x, y);
                for (int c = 0; c < 3; ++c)
                    worst = std::max(worst,
                                     std::abs(is[static_cast<std::size_t>(c)] - sum[c] / (factor * factor)));
            }
        }
        EXPECT_LE(worst, factor / 2) << factor << ": steps of the filter";
    }
}

// Along edges an enlarged image is nearer to one that is drawn large than by blending or square pixels, if
// its edges are smooth.
TEST_F(ResizeTest, EdgesAreNearestToALargeImage) {
    samples_ = 4;
    const base::Image large = drawAt(kShown, 100);
    const double edges = meanDifference(drawAt(kShown, 67, Upscaling::Edges), large);
    EXPECT_LT(edges, meanDifference(drawAt(kShown, 67, Upscaling::Linear), large));
    EXPECT_LT(edges, meanDifference(drawAt(kShown, 67, Upscaling::Nearest), large));
    EXPECT_GT(edges, 0);
}

TEST_F(ResizeTest, AScaleOf100ChangesNothing) {
    const base::Image plain = drawAt(kShown, 100);
    EXPECT_EQ(worstDifference(plain, drawAt(kShown, 100, Upscaling::Edges)), 0);
    EXPECT_GT(worstDifference(plain, drawAt(kShown, 50)), 0);
}

// What is drawn is never empty, nor larger than the driver allows.
TEST_F(ResizeTest, SizesHaveLimits) {
    EXPECT_EQ(drawAt({1, 1}, 25).width, 1);
    RenderOptions options;
    options.renderScale = 400;
    const int most = gpu::queryDevice().maxTextureSize;
    const auto refused = renderer_->configure({most / 2, 16}, options);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(std::to_string(2 * most)), std::string::npos)
        << refused.error().message;
    EXPECT_EQ(renderer_->size(), glm::ivec2(1)) << "the old size stays";
}

}  // namespace
}  // namespace terrane::render
