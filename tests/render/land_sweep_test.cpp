#include "terrane/render/land/land_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace terrane::render {
namespace {

constexpr int kGridSide = 96;
constexpr float kGridTexel = 8;

struct Grid {
    std::vector<float> blocks = std::vector<float>(static_cast<std::size_t>(kGridSide) * kGridSide);

    LandHeights heights() const { return {kGridSide, kGridTexel, blocks}; }
    float at(int x, int y) const { return blocks[static_cast<std::size_t>(y * kGridSide + x)]; }
    // Between texels; -1e9 beside the square.
    float at(glm::vec2 p) const {
        if (p.x < 0 || p.y < 0 || p.x > kGridSide - 1 || p.y > kGridSide - 1) return -1e9f;
        const int x = std::min(static_cast<int>(p.x), kGridSide - 2),
                  y = std::min(static_cast<int>(p.y), kGridSide - 2);
        const float u = p.x - static_cast<float>(x), v = p.y - static_cast<float>(y);
        return (1 - v) * ((1 - u) * at(x, y) + u * at(x + 1, y)) +
               v * ((1 - u) * at(x, y + 1) + u * at(x + 1, y + 1));
    }
};

template <class F>
Grid landOf(const F& height) {
    Grid land;
    for (int y = 0; y < kGridSide; ++y)
        for (int x = 0; x < kGridSide; ++x)
            land.blocks[static_cast<std::size_t>(y * kGridSide + x)] =
                height(static_cast<float>(x), static_cast<float>(y));
    return land;
}

// Waves at least 20 texels long.
Grid randomLand(std::mt19937& random) {
    std::uniform_real_distribution<float> part(0, 1);
    std::vector<std::array<float, 4>> waves;
    for (int k = 0; k < 5; ++k)
        waves.push_back({0.3f * (2 * part(random) - 1), 0.3f * (2 * part(random) - 1), 7 * part(random),
                         10 + 20 * part(random)});
    return landOf([&](float x, float y) {
        float sum = 100;
        for (const auto& w : waves) sum += w[3] * std::sin(w[0] * x + w[1] * y + w[2]);
        return sum;
    });
}

glm::vec3 lightAt(float azimuth, float elevation) {
    return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
            std::sin(elevation)};
}

std::vector<LandShadow> sweep(const Grid& land, glm::vec3 light, LandShadow outside = {kNoShadow, 0}) {
    std::vector<LandShadow> shadows(land.blocks.size());
    sweepShadows(
        land.heights(), light, [&](glm::vec2) { return outside; }, shadows);
    return shadows;
}

// The slow way: step by step toward the light.
LandShadow marched(const Grid& land, glm::vec3 light, glm::vec2 from) {
    const float across = glm::length(glm::vec2(light));
    const glm::vec2 ahead = glm::vec2(light) / across;
    LandShadow shadow{kNoShadow, 0};
    for (float texels = 1; texels < 1.5f * kGridSide; texels += 0.125f) {
        const float height = land.at(from + texels * ahead) - texels * kGridTexel * light.z / across;
        if (height > shadow.height) shadow = {height, texels * kGridTexel};
    }
    return shadow;
}

TEST(LandSweep, FindsTheShadowsOfASlowMarch) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> part(0, 1);
    int compared = 0, hidden = 0, different = 0;
    double heights = 0, distances = 0;
    for (int n = 0; n < 24; ++n) {
        const Grid land = randomLand(random);
        // Along the axes and the diagonals too.
        const float azimuth = n < 8 ? 0.785398163f * static_cast<float>(n) : 6.2831853f * part(random);
        const glm::vec3 light = lightAt(azimuth, 0.08f + 0.4f * part(random));
        const auto shadows = sweep(land, light);
        for (int k = 0; k < 300; ++k) {
            const int x = static_cast<int>(random() % kGridSide), y = static_cast<int>(random() % kGridSide);
            const LandShadow& fast = shadows[static_cast<std::size_t>(y * kGridSide + x)];
            const LandShadow slow = marched(land, light, {x, y});
            // Texels at the border are mixed with the outside.
            const glm::vec2 thrower =
                glm::vec2(x, y) + glm::normalize(glm::vec2(light)) * slow.distance / kGridTexel;
            const glm::vec2 inside = glm::min(thrower, static_cast<float>(kGridSide - 1) - thrower);
            if (std::min(inside.x, inside.y) < 6) continue;
            ++compared;
            heights += std::abs(fast.height - slow.height);
            ASSERT_NEAR(fast.height, slow.height, 10) << n << ": " << x << ' ' << y;
            const bool isHidden = slow.height > land.at(x, y);
            if (isHidden) {
                ++hidden;
                distances += std::abs(fast.distance - slow.distance);
            }
            if (isHidden != (fast.height > land.at(x, y))) ++different;
        }
    }
    EXPECT_GT(compared, 5000);
    EXPECT_GT(hidden, 1000);
    EXPECT_LT(heights / compared, 1);
    EXPECT_LT(different, compared / 50);
    EXPECT_LT(distances / hidden, 3 * kGridTexel);
}

// As steep as land that the light just touches, whatever its direction.
TEST(LandSweep, ASlopeInTheLightHasNoShadow) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> part(0, 1);
    for (int n = 0; n < 40; ++n) {
        const glm::vec3 light = lightAt(6.2831853f * part(random), 0.05f + 1.2f * part(random));
        const float steepest = 0.95f * light.z / glm::length(glm::vec2(light));
        const glm::vec2 rise = glm::normalize(glm::vec2(light)) * steepest * kGridTexel;
        const Grid land = landOf([&](float x, float y) { return 2000 + rise.x * x + rise.y * y; });
        const auto shadows = sweep(land, light);
        for (std::size_t k = 0; k < shadows.size(); ++k) ASSERT_LT(shadows[k].height, land.blocks[k]) << n;
    }
}

// Land outside the square throws shadows into it, and the shadows fall with distance.
TEST(LandSweep, ShadowsComeInFromOutside) {
    const Grid flat = landOf([](float, float) { return 10.0f; });
    for (const float azimuth : {0.0f, 0.6f, 1.5707963f, 2.5f, 3.1415927f, 4.0f, 5.5f}) {
        const glm::vec3 light = lightAt(azimuth, std::atan(0.1f));
        const auto shadows = sweep(flat, light, {100, 50});
        for (int y = 0; y < kGridSide; y += 5) {
            for (int x = 0; x < kGridSide; x += 5) {
                const LandShadow& s = shadows[static_cast<std::size_t>(y * kGridSide + x)];
                if (s.height < 12) continue;
                ASSERT_NEAR(s.height, 100 - 0.1f * (s.distance - 50), 0.01f) << azimuth;
                ASSERT_GT(s.distance, 50);
            }
        }
        const bool isAny = std::ranges::any_of(shadows, [](const LandShadow& s) { return s.height > 90; });
        EXPECT_TRUE(isAny) << azimuth;
    }
}

TEST(LandSweep, ALightAboveThrowsNone) {
    std::mt19937 random(3);
    for (const LandShadow& s : sweep(randomLand(random), {0, 0, 1})) ASSERT_EQ(s.height, kNoShadow);
}

float skyAt(const Grid& land, int x, int y) {
    std::vector<float> visibility(land.blocks.size());
    skyVisibility(land.heights(), 16, visibility);
    return visibility[static_cast<std::size_t>(y * kGridSide + x)];
}

TEST(LandSweep, ValleysSeeLessOfTheSky) {
    EXPECT_EQ(skyAt(landOf([](float, float) { return 80.0f; }), 40, 40), 1.0f);
    const Grid canyon = landOf([](float x, float) { return std::abs(x - 48) < 3 ? 20.0f : 120.0f; });
    EXPECT_LT(skyAt(canyon, 48, 48), 0.5f) << "six texels wide, 100 blocks deep";
    EXPECT_EQ(skyAt(canyon, 20, 48), 1.0f);
    const Grid ridge = landOf([](float x, float) { return 120 - 5 * std::abs(x - 48); });
    EXPECT_EQ(skyAt(ridge, 48, 48), 1.0f);
    // A slope of 45° toward ±x: the horizon's tangents are 1, and cos 45° on both sides of it.
    const Grid slope = landOf([](float x, float) { return kGridTexel * x; });
    EXPECT_NEAR(skyAt(slope, 20, 48), 1 - (0.5f + 2 / 3.0f) / 8, 0.02f);
}

}  // namespace
}  // namespace terrane::render
