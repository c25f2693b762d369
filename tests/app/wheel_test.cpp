#include "apps/terrane/window/input.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

TEST(Wheel, WholeStepsCountAtOnce) {
    Wheel wheel;
    EXPECT_EQ(wheel.turn(1), 1);
    EXPECT_EQ(wheel.turn(-1), -1);
    EXPECT_EQ(wheel.turn(3), 3);
}

TEST(Wheel, PartsAddUp) {
    Wheel wheel;
    EXPECT_EQ(wheel.turn(0.25), 0);
    EXPECT_EQ(wheel.turn(0.5), 0);
    EXPECT_EQ(wheel.turn(0.5), 1);
    EXPECT_EQ(wheel.turn(0.75), 1) << "a quarter was left";
}

TEST(Wheel, AnotherDirectionBeginsAnew) {
    Wheel wheel;
    EXPECT_EQ(wheel.turn(0.75), 0);
    EXPECT_EQ(wheel.turn(-0.5), 0);
    EXPECT_EQ(wheel.turn(-0.5), -1);
}

TEST(Wheel, ATurnSidewaysIsNoStep) {
    Wheel wheel;
    EXPECT_EQ(wheel.turn(0.5), 0);
    EXPECT_EQ(wheel.turn(0), 0);
    EXPECT_EQ(wheel.turn(0.5), 1);
}

}  // namespace
}  // namespace terrane::app
