#include "terrane/view/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace terrane::view {
namespace {

TEST(MonotoneCurve, GoesThroughItsValues) {
    const std::vector<double> times = {0, 1, 2.5, 7}, values = {3, -1, 8, 8};
    const MonotoneCurve curve(times, values);
    for (std::size_t k = 0; k < times.size(); ++k) EXPECT_DOUBLE_EQ(curve.at(times[k]), values[k]);
}

TEST(MonotoneCurve, StaysAtItsEnds) {
    const MonotoneCurve curve({1, 2}, {10, 20});
    EXPECT_EQ(curve.at(-5), 10);
    EXPECT_EQ(curve.at(1), 10);
    EXPECT_EQ(curve.at(2), 20);
    EXPECT_EQ(curve.at(1e9), 20);
}

TEST(MonotoneCurve, OneValueIsConstant) {
    const MonotoneCurve curve({4}, {7});
    for (const double t : {-1.0, 4.0, 5.0}) EXPECT_EQ(curve.at(t), 7);
}

TEST(MonotoneCurve, ValuesOnALineGiveTheLine) {
    const MonotoneCurve curve({0, 1, 3, 10}, {2, 5, 11, 32});
    for (double t = 0; t <= 10; t += 0.1) EXPECT_NEAR(curve.at(t), 2 + 3 * t, 1e-12);
}

// The camera stands where two keys are the same: it does not swing about.
TEST(MonotoneCurve, StandsBetweenEqualValues) {
    const MonotoneCurve curve({0, 1, 2, 3}, {0, 50, 50, -20});
    for (double t = 1; t <= 2; t += 0.05) EXPECT_DOUBLE_EQ(curve.at(t), 50);
}

class MonotoneCurveRandom : public testing::TestWithParam<unsigned> {
  protected:
    MonotoneCurveRandom() {
        std::minstd_rand random(GetParam());
        std::uniform_real_distribution<double> step(0.01, 3), value(-100, 100);
        for (double t = 0; times.size() < 12; t += step(random)) {
            times.push_back(t);
            values.push_back(value(random));
        }
    }
    std::vector<double> times, values;
};

TEST_P(MonotoneCurveRandom, IsMonotoneBetweenTwoValues) {
    const MonotoneCurve curve(times, values);
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
        const double direction = values[k + 1] > values[k] ? 1 : -1;
        double before = values[k];
        for (int n = 1; n <= 50; ++n) {
            const double now = curve.at(times[k] + (times[k + 1] - times[k]) * n / 50);
            EXPECT_GE(direction * (now - before), -1e-9) << k << ' ' << n;
            before = now;
        }
    }
}

// No jerk at a key: the speed before it is the speed after it.
TEST_P(MonotoneCurveRandom, HasNoCorners) {
    const MonotoneCurve curve(times, values);
    constexpr double kStep = 1e-8;
    for (std::size_t k = 1; k + 1 < times.size(); ++k) {
        const double before = (curve.at(times[k]) - curve.at(times[k] - kStep)) / kStep;
        const double after = (curve.at(times[k] + kStep) - curve.at(times[k])) / kStep;
        EXPECT_NEAR(before, after, 0.02) << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, MonotoneCurveRandom, testing::Range(1u, 21u));

TEST(MonotoneCurve, NeedsATimeForEachValue) {
    EXPECT_THROW(MonotoneCurve({}, {}), std::invalid_argument);
    EXPECT_THROW(MonotoneCurve({1, 2}, {3}), std::invalid_argument);
    EXPECT_THROW(MonotoneCurve({1, 1, 2}, {3, 4, 5}), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::view
