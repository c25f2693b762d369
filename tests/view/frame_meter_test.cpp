#include "terrane/view/frame_times.h"

#include <gtest/gtest.h>

#include <cmath>

namespace terrane::view {
namespace {

TEST(FrameMeter, NothingIsZero) {
    const FrameMeter meter;
    EXPECT_EQ(meter.now(), 0);
    EXPECT_EQ(meter.min(), 0);
    EXPECT_EQ(meter.max(), 0);
}

TEST(FrameMeter, TellsTheRangeOfTheLastSecond) {
    FrameMeter meter;
    meter.add(0.5);
    for (int k = 0; k < 50; ++k) meter.add(0.01);
    EXPECT_NEAR(meter.now(), 51, 1e-6);
    EXPECT_NEAR(meter.min(), 2, 1e-6);
    EXPECT_NEAR(meter.max(), 100, 1e-6);
    for (int k = 0; k < 60; ++k) meter.add(0.01);  // the long frame is more than a second ago
    EXPECT_NEAR(meter.now(), 100, 1e-6);
    EXPECT_NEAR(meter.min(), 100, 1e-6);
}

TEST(FrameMeter, AFrameLongerThanASecondCounts) {
    FrameMeter meter;
    meter.add(0.01);
    meter.add(4);
    EXPECT_NEAR(meter.now(), 0.25, 1e-9);
    EXPECT_NEAR(meter.min(), 0.25, 1e-9);
}

TEST(FrameMeter, FramesOfNoLengthAreNoDivisionByZero) {
    FrameMeter meter;
    meter.add(0);
    EXPECT_EQ(meter.now(), 0);
    EXPECT_TRUE(std::isfinite(meter.max()));
}

TEST(FrameMeter, CountsTheFramesOfEachSecond) {
    FrameMeter meter;
    EXPECT_EQ(meter.lastSecond(), 0);
    EXPECT_EQ(meter.mode(), 0);
    const auto second = [&](int frames) {
        for (int k = 0; k < frames; ++k) meter.add(1.0 / frames);
    };
    for (const int frames : {4, 8, 4, 16, 8, 4}) {
        second(frames);
        EXPECT_EQ(meter.lastSecond(), frames);
    }
    EXPECT_EQ(meter.mode(), 4);
    second(8);
    EXPECT_EQ(meter.mode(), 8) << "of equals the higher";
}

TEST(FrameMeter, AFrameOfSecondsLeavesSecondsWithoutFrames) {
    FrameMeter meter;
    meter.add(3.25);
    EXPECT_EQ(meter.lastSecond(), 0);
    EXPECT_EQ(meter.mode(), 0);
    meter.add(0.75);
    EXPECT_EQ(meter.lastSecond(), 1);
}

}  // namespace
}  // namespace terrane::view
