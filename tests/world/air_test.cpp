#include "terrane/world/sky/air.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace terrane::world {
namespace {

bool isShare(glm::vec3 v) {
    return v.x >= 0 && v.x <= 1 && v.y >= 0 && v.y <= 1 && v.z >= 0 && v.z <= 1;
}

TEST(Air, GetsThinnerWithHeight) {
    for (float altitude = 0; altitude < kAirTop; altitude += 500) {
        const AirDensity low = airDensity(altitude), high = airDensity(altitude + 500);
        EXPECT_LT(high.rayleigh, low.rayleigh);
        EXPECT_LE(high.haze, low.haze);
        EXPECT_GE(low.ozone, 0);
        EXPECT_LE(low.ozone, 1);
    }
    EXPECT_LT(kHazeScattering, kHazeExtinction) << "haze gives back no more than it takes";
    // As in the shader.
    EXPECT_FLOAT_EQ(kRayleigh.y, 2 * kRayleigh.x);
    EXPECT_FLOAT_EQ(kRayleigh.z, 5 * kRayleigh.x);
}

TEST(Air, LeavesAShareOfTheLightThatFallsTowardTheHorizon) {
    for (const float altitude : {0.0f, 100.0f, 2000.0f, 20000.0f}) {
        glm::vec3 before(1);
        for (float sine = 1; sine >= 0; sine -= 0.01f) {
            const glm::vec3 left = transmittanceToSpace(altitude, sine);
            ASSERT_TRUE(isShare(left)) << altitude << " " << sine;
            ASSERT_LE(left.y, before.y + 1e-6f) << altitude << " " << sine;
            ASSERT_GE(left.x, left.z) << "blue is lost first";
            before = left;
        }
    }
    EXPECT_GT(transmittanceToSpace(3000, 0.1f).y, transmittanceToSpace(0, 0.1f).y);
    EXPECT_EQ(transmittanceToSpace(100, -0.1f), glm::vec3(0)) << "the ground is in the way";
    EXPECT_GT(transmittanceToSpace(20000, -0.05f).x, 0.01f) << "high above it is not";
}

// Straight up the depth of an exponential density is its scale height.
TEST(Air, TakesStraightUpWhatItsColumnHolds) {
    const float ozone = 3750 * 9e-6f;
    const float depth = kRayleigh.y * kRayleighScale + kHazeExtinction * kHazeScale + ozone;
    EXPECT_NEAR(transmittanceToSpace(0, 1).y, std::exp(-depth), 0.01f);
}

// Integrated over the whole sphere, a phase function gives 1.
TEST(Air, ScatteringLosesNoLight) {
    double rayleigh = 0, haze = 0;
    constexpr int kSteps = 20000;
    for (int k = 0; k < kSteps; ++k) {
        const float cosine = (static_cast<float>(k) + 0.5f) * 2 / kSteps - 1;
        rayleigh += static_cast<double>(rayleighPhase(cosine)) * 4 * std::numbers::pi / kSteps;
        haze += static_cast<double>(hazePhase(cosine)) * 4 * std::numbers::pi / kSteps;
    }
    EXPECT_NEAR(rayleigh, 1, 1e-3);
    EXPECT_NEAR(haze, 1, 1e-3);
    EXPECT_GT(hazePhase(1), 100 * hazePhase(-1)) << "haze scatters forward";
    EXPECT_FLOAT_EQ(rayleighPhase(0.5f), rayleighPhase(-0.5f));
}

}  // namespace
}  // namespace terrane::world
