#include "terrane/render/frame/scale_governor.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace terrane::render {
namespace {

constexpr double kTarget = 1000.0 / 30;

// Milliseconds of a frame at a scale.
using Load = std::function<double(int scale)>;

Load pixels(double fixed, double atFullSize) {
    return [=](int scale) { return fixed + atFullSize * scale * scale / 10'000; };
}

class ScaleGovernorTest : public ::testing::Test {
  protected:
    // Returns the scales in use over the last half of the time.
    std::set<int> play(const Load& load, double seconds, int most = 100) {
        std::set<int> used;
        for (double time = 0; time < seconds;) {
            const int scale = governor_.scaleFor(most);
            const double milliseconds = load(scale);
            governor_.add({milliseconds / 1000, milliseconds, true}, kTarget, most);
            time += milliseconds / 1000;
            if (time > seconds / 2) used.insert(scale);
        }
        return used;
    }

    ScaleGovernor governor_;
};

TEST_F(ScaleGovernorTest, FastFramesKeepTheFullSize) {
    EXPECT_EQ(play(pixels(5, 10), 20), std::set{100});
    EXPECT_EQ(play(pixels(5, 10), 20, 67), std::set{67}) << "that the player chose";
}

// Whatever pixels cost, a scale is found at which frames hold the target, and it stays.
TEST_F(ScaleGovernorTest, TheLargestImageThatHoldsTheTargetIsFoundAndKept) {
    for (double fixed = 2; fixed < 20; fixed += 3) {
        for (double full = 20; full < 90; full += 10) {
            governor_.reset();
            const Load load = pixels(fixed, full);
            const std::set<int> used = play(load, 30);
            ASSERT_EQ(used.size(), 1u) << fixed << " + " << full << ": does not oscillate";
            const int scale = *used.begin();
            if (load(50) <= kTarget) {
                EXPECT_LE(load(scale), ScaleGovernor::kTooLong * kTarget);
            }
            if (scale == 100) continue;
            // The next larger one would be too slow, or nearly.
            const std::vector<int> scales = governedScales(100);
            const int larger = *std::upper_bound(scales.begin(), scales.end(), scale);
            EXPECT_GT(load(larger), 0.6 * kTarget) << fixed << " + " << full << " at " << scale;
        }
    }
}

TEST_F(ScaleGovernorTest, WherePixelsAreNotTheReasonTheImageStaysLarge) {
    std::set<int> used = play(pixels(60, 1), 30);
    used.erase(*used.begin() < 100 ? *used.begin() : 0);  // a try now and then
    EXPECT_EQ(used, std::set{100});
}

TEST_F(ScaleGovernorTest, AHeavyViewPasses) {
    play(pixels(5, 60), 10);
    EXPECT_LT(governor_.scaleFor(100), 100);
    play(pixels(5, 10), 15);
    EXPECT_EQ(governor_.scaleFor(100), 100);
}

TEST_F(ScaleGovernorTest, LoadingAndSingleSlowFramesChangeNothing) {
    for (int k = 0; k < 200; ++k) governor_.add({0.1, 100, false}, kTarget, 100);
    EXPECT_EQ(governor_.scaleFor(100), 100);
    int frame = 0;
    EXPECT_EQ(play([&](int) { return ++frame % 10 == 0 ? 120.0 : 20.0; }, 20), std::set{100});
}

}  // namespace
}  // namespace terrane::render
