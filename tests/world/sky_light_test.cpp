#include "terrane/world/sky/environment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace terrane::world {
namespace {

constexpr float kPi = 3.14159265f;

glm::vec3 direction(float sine, float azimuth) {
    const float level = std::sqrt(1 - sine * sine);
    return {level * std::cos(azimuth), level * std::sin(azimuth), sine};
}

TEST(SkyLight, TablesAgreeWithIntegration) {
    for (const float altitude : {0.0f, 90.0f, 700.0f, 3000.0f, 9000.0f}) {
        for (float sine = 0.02f; sine < 1; sine += 0.031f) {
            const glm::vec3 exact = transmittanceToSpace(altitude, sine),
                            table = airLight(altitude, sine).direct;
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(table[c], exact[c], 0.012f) << altitude << " " << sine;
        }
    }
}

TEST(SkyLight, OfTheWholeSkyIsLessThanTheAirTakes) {
    for (float sine = 0.05f; sine <= 1; sine += 0.05f) {
        const glm::vec3 sky = skyIrradiance(sine), sun = directLight(sine) * sine;
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(sky[c], 0);
            // The ground reflects three tenths of the light, of which the air scatters a part back.
            EXPECT_LT(sky[c] + sun[c], 1.1f * sine + 0.02f) << sine;
        }
    }
}

TEST(SkyLight, IsBrighterTowardTheHorizonByDayAndBlueAbove) {
    const glm::vec3 toLight = direction(0.7f, 0);
    for (const float azimuth : {kPi / 2, 2.0f, kPi}) {
        const glm::vec3 low = skyRadiance(direction(0.02f, azimuth), toLight);
        const glm::vec3 middle = skyRadiance(direction(0.3f, azimuth), toLight);
        EXPECT_GT(low.y, 1.5f * middle.y) << azimuth;
        EXPECT_GT(middle.z, 1.5f * middle.x) << azimuth;
        EXPECT_LT(low.z / low.x, middle.z / middle.x) << "the horizon is paler";
    }
}

TEST(SkyLight, IsTheSameOnBothSidesOfTheLight) {
    const glm::vec3 toLight = direction(0.2f, 0);
    for (const float azimuth : {0.3f, 1.0f, 2.5f}) {
        const glm::vec3 a = skyRadiance(direction(0.4f, azimuth), toLight),
                        b = skyRadiance(direction(0.4f, -azimuth), toLight);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-5f * a[c]);
    }
}

TEST(SkyLight, OfALowSunIsRedUnderItAndBlueInTheBlueHour) {
    const glm::vec3 sun = directLight(0.03f);
    EXPECT_GT(sun.x, 2 * sun.y);
    EXPECT_GT(sun.y, 2 * sun.z);
    const glm::vec3 zenith = skyRadiance({0, 0, 1}, direction(-0.06f, 0));
    EXPECT_GT(zenith.z, 1.5f * zenith.y);
    EXPECT_GE(zenith.y, zenith.x) << "not purple";
    EXPECT_EQ(directLight(-kDiscFade), glm::vec3(0));
}

// Half of a texel aside, where linear interpolation is farthest off. Near the light haze is steep.
TEST(SkyLight, TableIsTheSkyBetweenItsTexels) {
    for (const float sine : {-0.05f, 0.02f, 0.3f, 0.89f}) {
        const SkyTable table = skyTable(sine);
        const glm::vec3 toLight = direction(sine, 0);
        float mean = 0, worst = 0;
        int count = 0;
        for (int row = 0; row + 1 < SkyTable::kRows; ++row) {
            for (int column = 0; column + 1 < SkyTable::kColumns; column += 3, ++count) {
                const float v = (static_cast<float>(row) + 0.5f) / (SkyTable::kRows - 1);
                const float u = (static_cast<float>(column) + 0.5f) / (SkyTable::kColumns - 1);
                const glm::vec3 at = direction(v * v, 2 * std::asin(u));
                const glm::vec3 exact = skyRadiance(at, toLight), found = sampled(table, at, toLight);
                for (int c = 0; c < 3; ++c) {
                    const float off = std::abs(found[c] - exact[c]) / exact[c];
                    worst = std::max(worst, off);
                    mean += off / 3;
                }
            }
        }
        EXPECT_LT(mean / static_cast<float>(count), 0.012f) << sine;
        EXPECT_LT(worst, 0.15f) << sine;
    }
}

// The light may be in any direction, not only toward +x.
TEST(SkyLight, TableTurnsWithTheLight) {
    const SkyTable table = skyTable(0.3f);
    const glm::vec3 a = sampled(table, direction(0.2f, 0.4f), direction(0.3f, 0)),
                    b = sampled(table, direction(0.2f, 2.4f), direction(0.3f, 2.0f));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-4f * a[c]);
}

}  // namespace
}  // namespace terrane::world
