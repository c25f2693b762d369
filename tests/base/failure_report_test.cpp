#include <gtest/gtest.h>

#include "terrane/base/timing.h"

namespace terrane::base {
namespace {

using namespace std::chrono_literals;

TEST(FailureReport, TellsOfTheFirstFailureAndOfALastingEnd) {
    FailureReport report(10s);
    FailureReport::Time now{};
    EXPECT_FALSE(report.hasEnded(now)) << "nothing has failed";
    EXPECT_TRUE(report.hasBegun());
    EXPECT_FALSE(report.hasBegun());
    EXPECT_EQ(report.reportAt(), FailureReport::Time::max());
    EXPECT_FALSE(report.hasEnded(now));
    EXPECT_EQ(report.reportAt(), now + 10s);
    EXPECT_FALSE(report.hasEnded(now + 9s));
    EXPECT_FALSE(report.hasBegun()) << "the same failure goes on";
    EXPECT_FALSE(report.hasEnded(now + 12s)) << "works for a new while";
    EXPECT_FALSE(report.hasEnded(now + 21s));
    EXPECT_TRUE(report.hasEnded(now + 22s));
    EXPECT_FALSE(report.hasEnded(now + 40s)) << "told once";
    EXPECT_EQ(report.reportAt(), FailureReport::Time::max());
    EXPECT_TRUE(report.hasBegun()) << "another failure";
}

}  // namespace
}  // namespace terrane::base
