#include "terrane/world/sky/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace terrane::world {
namespace {

constexpr int kSteps = 20000;  // of the day: 4.3 seconds each

float timeOf(int step) {
    return static_cast<float>(step) / kSteps;
}

std::array<glm::vec3, 5> colorsOf(const Environment& e) {
    return {e.lightColor, e.ambientColor, e.zenithColor, e.horizonColor, e.glowColor};
}

float largest(glm::vec3 v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

bool isMoon(const Environment& e) {
    return e.discRadius < environmentAt(0.5f).discRadius;
}

// A step of the day may change a color by at most the smallest difference of a screen.
TEST(Environment, ColorsChangeWithoutJumps) {
    for (int step = 0; step < kSteps; ++step) {
        const auto now = colorsOf(environmentAt(timeOf(step))),
                   next = colorsOf(environmentAt(timeOf(step + 1)));
        for (std::size_t c = 0; c < now.size(); ++c) {
            ASSERT_LT(largest(next[c] - now[c]), 0.003f) << "color " << c << " at " << timeOf(step);
        }
    }
}

TEST(Environment, LightMovesWithoutJumps) {
    for (int step = 0; step < kSteps; ++step) {
        const Environment now = environmentAt(timeOf(step)), next = environmentAt(timeOf(step + 1));
        ASSERT_LT(glm::distance(now.lightDirection, next.lightDirection), 0.002f) << "at " << timeOf(step);
        ASSERT_NEAR(glm::length(now.lightDirection), 1, 1e-5f);
    }
}

TEST(Environment, SunAndMoonTakeTurnsInTheDark) {
    int turns = 0;
    for (int step = 0; step < kSteps; ++step) {
        const Environment now = environmentAt(timeOf(step)), next = environmentAt(timeOf(step + 1));
        if (isMoon(now) == isMoon(next)) continue;
        ++turns;
        EXPECT_LT(largest(now.lightColor), 0.003f) << "the disc changes its size at " << timeOf(step);
    }
    EXPECT_EQ(turns, 2);
}

TEST(Environment, SunIsHighestAtNoon) {
    const float noon = environmentAt(0.5f).lightDirection.z;
    EXPECT_GT(noon, 0.7f);
    for (const float time : {0.3f, 0.4f, 0.6f, 0.7f}) {
        EXPECT_LT(environmentAt(time).lightDirection.z, noon) << time;
        EXPECT_GT(environmentAt(time).lightDirection.z, 0) << time;
    }
}

TEST(Environment, SunGoesFromEastToWest) {
    EXPECT_LT(environmentAt(0.25f).lightDirection.x, -0.5f);
    EXPECT_NEAR(environmentAt(0.5f).lightDirection.x, 0, 1e-3f);
    EXPECT_GT(environmentAt(0.75f).lightDirection.x, 0.5f);
    EXPECT_LT(std::abs(environmentAt(0.2f).lightDirection.z), 0.35f) << "near the horizon at dawn";
    EXPECT_LT(std::abs(environmentAt(0.8f).lightDirection.z), 0.35f) << "near the horizon at dusk";
}

TEST(Environment, MoonStandsAtNight) {
    EXPECT_TRUE(isMoon(environmentAt(0.0f)));
    EXPECT_GT(environmentAt(0.0f).lightDirection.z, 0.7f);
    EXPECT_GT(environmentAt(0.95f).lightDirection.x, environmentAt(0.05f).lightDirection.x) << "backwards";
    EXPECT_LT(largest(environmentAt(0.0f).lightColor), 0.3f * largest(environmentAt(0.5f).lightColor));
}

TEST(Environment, DayIsBrightAndBlue) {
    const Environment noon = environmentAt(0.5f), midnight = environmentAt(0.0f);
    EXPECT_GT(noon.zenithColor.z, 2 * noon.zenithColor.x);
    EXPECT_GT(largest(noon.horizonColor), 10 * largest(midnight.horizonColor));
    EXPECT_GT(noon.lightColor.x, 0.5f);
    EXPECT_GT(environmentAt(0.2f).lightColor.x, 2 * environmentAt(0.2f).lightColor.z) << "dawn is red";
}

// The brightness that scenes and presets were made for.
TEST(Environment, NoonKeepsItsLevels) {
    const Environment noon = environmentAt(0.5f);
    EXPECT_NEAR(noon.lightColor.y, 0.79f, 0.1f);
    EXPECT_NEAR(noon.ambientColor.y, 0.58f, 0.08f);
    EXPECT_NEAR(noon.horizonColor.y, 0.6f, 0.15f);
}

TEST(Environment, UnderTheHorizonThereIsNoLightButTheSky) {
    for (int step = 0; step < kSteps; ++step) {
        const Environment e = environmentAt(timeOf(step));
        if (e.lightDirection.z > -kDiscFade) continue;
        ASSERT_EQ(largest(e.lightColor), 0) << timeOf(step);
        ASSERT_GT(e.ambientColor.y, 0.01f) << timeOf(step);
    }
}

// The table gives the colors of the environment, at all times except when the light changes.
TEST(Environment, TableOfTheSkyHasItsColors) {
    for (const float time : {0.0f, 0.1f, 0.19f, 0.3f, 0.5f, 0.79f}) {
        const Environment e = environmentAt(time);
        const glm::vec3 zenith =
            sampled(skyColorTable(e.lightDirection.z, e.isMoon), {0, 0, 1}, e.lightDirection);
        EXPECT_LT(largest(zenith - e.zenithColor), 0.01f * largest(e.zenithColor)) << time;
        EXPECT_EQ(ambientGreen(e.lightDirection.z, e.isMoon), e.ambientColor.y);
    }
}

// A step is 0.6 seconds of a day of 20 minutes. At sunrise the horizon under the sun gets brighter by a tenth
// of white in one, but no texel's change may set in or end within a step.
TEST(Environment, SkyChangesWithoutJumps) {
    constexpr int kTimes = 2000;
    const auto tableAt = [](int k) {
        const Environment e = environmentAt(static_cast<float>(k) / kTimes);
        return skyColorTable(e.lightDirection.z, e.isMoon);
    };
    SkyTable before = tableAt(199), now = tableAt(200);
    for (int k = 200; k < 460; ++k) {  // moonset, dawn, sunrise
        const SkyTable next = tableAt(k + 1);
        for (std::size_t t = 0; t < now.radiance.size(); ++t) {
            const glm::vec3 a = before.radiance[t], b = now.radiance[t], c = next.radiance[t];
            ASSERT_LT(largest(c - b - (b - a)), 0.03f) << "at " << k << " texel " << t;
            ASSERT_LT(largest(c - b), 0.12f) << "at " << k << " texel " << t;
        }
        before = now;
        now = next;
    }
}

TEST(Environment, OnlyTheFractionOfTheTimeCounts) {
    for (const float time : {0.0f, 0.25f, 0.5f, 0.75f}) {
        EXPECT_EQ(colorsOf(environmentAt(time)), colorsOf(environmentAt(time + 1)));
        EXPECT_EQ(colorsOf(environmentAt(time)), colorsOf(environmentAt(time - 3)));
    }
}

}  // namespace
}  // namespace terrane::world
