#include "terrane/path/denoise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terrane/path/random.h"

namespace terrane::path {
namespace {

constexpr glm::ivec2 kDenoisedSize{64, 48};

// A wall with a checkered texture; the light on its right half is 4 times as bright, and behind its upper
// part is the sky. Noise has a variance that is known.
Means noisyWall(float noise) {
    Means means;
    means.size = kDenoisedSize;
    for (int y = 0; y < kDenoisedSize.y; ++y) {
        for (int x = 0; x < kDenoisedSize.x; ++x) {
            const bool isSky = y < 8;
            const float albedo = ((x ^ y) & 1) != 0 ? 0.8f : 0.2f, light = x < 32 ? 0.25f : 1;
            Random random{static_cast<std::uint32_t>(x + 64 * y), 0, 3};
            const float error = isSky ? 0 : noise * albedo * (2 * random.next() - 1);
            means.radiance.emplace_back(isSky ? 0.5f : albedo * light + error);
            means.albedo.emplace_back(isSky ? 0 : albedo);
            means.normal.emplace_back(isSky ? glm::vec3(0) : glm::vec3(0, 0, 1));
            means.depth.push_back(isSky ? 0.0f : 10.0f);
            means.variance.push_back(isSky ? 0 : noise * noise * albedo * albedo);
        }
    }
    return means;
}

double distance(const Means& a, const Means& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.radiance.size(); ++k)
        sum += std::pow(double{a.radiance[k].x - b.radiance[k].x}, 2);
    return std::sqrt(sum / static_cast<double>(a.radiance.size()));
}

TEST(DenoiseTest, NoiseGoesAndEdgesStay) {
    base::JobSystem jobs(2);
    const Means truth = noisyWall(0);
    Means noisy = noisyWall(0.1f);
    const double before = distance(noisy, truth);
    denoise(noisy, jobs);
    EXPECT_LT(distance(noisy, truth), before / 4);
    const auto at = [&](int x, int y) {
        return noisy.radiance[static_cast<std::size_t>(x + y * kDenoisedSize.x)].x;
    };
    EXPECT_NEAR(at(10, 20) / at(11, 20), 0.25, 0.03) << "the texture";
    EXPECT_NEAR(at(30, 20) / at(32, 20), 0.25, 0.05) << "the border of light";
    EXPECT_EQ(at(10, 7), 0.5f) << "the sky";
}

TEST(DenoiseTest, WithoutNoiseNothingChanges) {
    base::JobSystem jobs(2);
    const Means truth = noisyWall(0);
    Means same = truth;
    denoise(same, jobs);
    EXPECT_LT(distance(same, truth), 1e-3);
}

}  // namespace
}  // namespace terrane::path
