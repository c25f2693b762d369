#include "terrane/view/shots.h"

#include <gtest/gtest.h>

namespace terrane::view {
namespace {

Shot shotFrom(double start) {
    return {.name = "",
            .start = start,
            .seconds = 2,
            .path = CameraPath({CameraKey{}}),
            .options = {{0, {"low"}, render::View::Color}, {1, {"low"}, render::View::Depth}},
            .titles = {},
            .edits = {},
            .players = {}};
}

TEST(ShotAt, HoldsUntilTheNextOneStarts) {
    const std::vector<Shot> shots{shotFrom(0), shotFrom(2)};
    EXPECT_EQ(&shotAt(shots, 0), &shots[0]);
    EXPECT_EQ(&shotAt(shots, 1.99), &shots[0]);
    EXPECT_EQ(&shotAt(shots, 2 - kTimeSlack / 2), &shots[1]) << "rounding";
    EXPECT_EQ(&shotAt(shots, 99), &shots[1]);
}

TEST(OptionsAt, HoldUntilTheyChange) {
    const Shot shot = shotFrom(0);
    EXPECT_EQ(optionsAt(shot, 0.99).view, render::View::Color);
    EXPECT_EQ(optionsAt(shot, 1).view, render::View::Depth);
    EXPECT_EQ(optionsAt(shot, 99).view, render::View::Depth);
}

}  // namespace
}  // namespace terrane::view
