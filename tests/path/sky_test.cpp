#include "terrane/path/sky.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>

#include "terrane/path/random.h"

namespace terrane::path {
namespace {

Sky skyAt(float time) {
    const world::Environment e = world::environmentAt(time);
    shared::AirFrame air{};
    air.lightAzimuth.z = e.ambientColor.y;
    return skyOf(e, air);
}

// The mean of 1 / density over sampled directions is the solid angle of the upper half, and the density's
// integral over equally dense directions is 1.
TEST(PathSkyTest, DensitiesAreThoseOfSamples) {
    constexpr int kCount = 200'000;
    for (const float time : {0.21f, 0.5f, 0.9f}) {
        const Sky sky = skyAt(time);
        double angle = 0, mass = 0;
        Random random;
        for (int k = 0; k < kCount; ++k) {
            random.sample = static_cast<std::uint32_t>(k);
            random.dimension = 0;
            const glm::vec3 direction = sampleSky(sky, random.next2());
            ASSERT_NEAR(glm::length(direction), 1, 1e-4);
            const float density = skyDensity(sky, direction);
            ASSERT_GT(density, 0);
            angle += 1 / double{density};
            const float z = random.next(), level = std::sqrt(1 - z * z), turn = 6.2831853f * random.next();
            mass += double{skyDensity(sky, {level * std::cos(turn), level * std::sin(turn), z})};
        }
        const double half = 2 * std::acos(-1.0);
        EXPECT_NEAR(angle / kCount, half, 0.03 * half) << time;
        EXPECT_NEAR(mass / kCount * half, 1, 0.02) << time;
    }
}

TEST(PathSkyTest, DirectionsOfTheDiscAreInIt) {
    const Sky sky = skyAt(0.5f);
    Random random;
    glm::vec3 sum(0);
    for (std::uint32_t k = 0; k < 1000; ++k) {
        random.sample = k;
        random.dimension = 0;
        const glm::vec3 direction = sampleDisc(sky, random.next2());
        EXPECT_GE(glm::dot(direction, sky.toLight), sky.discCosine - 1e-5f);
        sum += direction;
    }
    EXPECT_GT(glm::dot(glm::normalize(sum), sky.toLight), 0.9999f);
}

TEST(PathSkyTest, FramesArePerpendicular) {
    for (const glm::vec3 n : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0),
                              glm::vec3(0, -1, 0), glm::normalize(glm::vec3(1, 2, -3))}) {
        const Frame frame = frameOf(n);
        EXPECT_NEAR(glm::dot(frame.across, n), 0, 1e-6);
        EXPECT_NEAR(glm::dot(frame.along, n), 0, 1e-6);
        EXPECT_NEAR(glm::length(glm::cross(frame.across, frame.along)), 1, 1e-6);
    }
}

}  // namespace
}  // namespace terrane::path
