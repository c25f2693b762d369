#include "terrane/game/player_state.h"

#include <gtest/gtest.h>

namespace terrane::game {
namespace {

TEST(DayClock, ADayEndsWhereTheNextBegins) {
    DayClock day{.timeDay = 0.9, .dayMinutes = 1};
    day.advance(12);
    EXPECT_NEAR(day.timeDay, 0.1, 1e-9);
    day.shift(-0.2);
    EXPECT_NEAR(day.timeDay, 0.9, 1e-9);
    day.isRunning = false;
    day.advance(30);
    EXPECT_NEAR(day.timeDay, 0.9, 1e-9);
}

TEST(DayClock, OnlyNumbersOfADayAreTimes) {
    EXPECT_EQ(parseTimeDay("0.25"), 0.25);
    EXPECT_EQ(parseTimeDay("0"), 0.0);
    EXPECT_EQ(parseTimeDay("1"), 1.0);
    for (const char* text : {"", "nan", "inf", "-inf", "1.5", "-0.1", "0.5x", "noon", " 0.5", "1e400"}) {
        EXPECT_FALSE(parseTimeDay(text)) << text;
    }
}

}  // namespace
}  // namespace terrane::game
