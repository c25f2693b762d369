#include "terrane/base/timing.h"

#include <gtest/gtest.h>

namespace terrane::base {
namespace {

TEST(TimedValue, IsFoundAgainAfterThePause) {
    TimedValue<int> value(0.5);
    int found = 0;
    for (int frame = 0; frame < 1000; ++frame) {
        EXPECT_EQ(value.at(frame * 0.01, [&] { return ++found; }), found);
    }
    EXPECT_NEAR(found, 20, 1);
}

}  // namespace
}  // namespace terrane::base
