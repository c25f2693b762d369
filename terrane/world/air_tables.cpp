#include "terrane/world/air_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace terrane::world {
namespace {

constexpr float kGroundAlbedo = 0.3f;
// The horizon hides a disc, not a point: light fades over this much of the sine.
constexpr float kHorizonFade = 0.01f;

// Rows: equal steps of the root of the altitude. Columns: of the root of the sine over the horizon's sine.
template <int Columns, int Rows>
struct Grid {
    std::array<glm::vec3, std::size_t{Columns} * Rows> entries;

    glm::vec3& at(int column, int row) { return entries[static_cast<std::size_t>(row * Columns + column)]; }
    glm::vec3 sample(float x, float y) const {
        x *= Columns - 1;
        y *= Rows - 1;
        const int column = std::min(static_cast<int>(x), Columns - 2),
                  row = std::min(static_cast<int>(y), Rows - 2);
        const glm::vec3* first = &entries[static_cast<std::size_t>(row * Columns + column)];
        const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
        return glm::mix(glm::mix(first[0], first[1], u), glm::mix(first[Columns], first[Columns + 1], u), v);
    }
};

constexpr int kSines = 96, kAltitudes = 24, kAroundSines = 64, kAroundAltitudes = 10;
constexpr float kLowestSine = -0.35f;  // of the table of scattered light: the sun 20° down

float horizonSine(float altitude) {
    const float share = kPlanetRadius / (kPlanetRadius + altitude);
    return -std::sqrt(std::max(1 - share * share, 0.0f));
}

float altitudeOf(int row, int rows) {
    const float root = static_cast<float>(row) / static_cast<float>(rows - 1);
    return kAirTop * root * root;
}

struct Tables {
    Grid<kSines, kAltitudes> direct;
    Grid<kAroundSines, kAroundAltitudes> around;

    Tables();
    glm::vec3 directAt(float altitude, float sine) const {
        const float horizon = horizonSine(altitude), over = sine - horizon;
        if (over <= -kHorizonFade) return glm::vec3(0);
        const float x = std::sqrt(glm::clamp(over / (1 - horizon), 0.0f, 1.0f));
        const float y = std::sqrt(glm::clamp(altitude / kAirTop, 0.0f, 1.0f));
        return direct.sample(x, y) * glm::smoothstep(-kHorizonFade, kHorizonFade, over);
    }
    glm::vec3 aroundAt(float altitude, float sine) const {
        return around.sample(glm::clamp((sine - kLowestSine) / (1 - kLowestSine), 0.0f, 1.0f),
                             std::sqrt(glm::clamp(altitude / kAirTop, 0.0f, 1.0f)));
    }
    glm::vec3 scattered(float altitude, float sine) const;
};

struct Gathered {
    // As seen from there: light that was scattered once, and the same if the light were 1 everywhere.
    glm::vec3 light{0}, share{0};
};

// Integrates along a direction, with phase functions that are equal on all sides (Hillaire 2020, equations 5
// to 8).
Gathered gather(const Tables& tables, float altitude, glm::vec3 direction, glm::vec3 toLight) {
    constexpr int kSteps = 12;
    const float from = kPlanetRadius + altitude, top = kPlanetRadius + kAirTop, along = from * direction.z;
    const float nearest2 = from * from - along * along;
    const bool hitsGround = direction.z < 0 && nearest2 < kPlanetRadius * kPlanetRadius;
    const float length = hitsGround ? -along - std::sqrt(kPlanetRadius * kPlanetRadius - nearest2)
                                    : std::sqrt(std::max(top * top - nearest2, 0.0f)) - along;
    const float cosine = glm::dot(direction, toLight);
    const auto lightSine = [&](float t, float radius) { return (from * toLight.z + t * cosine) / radius; };
    Gathered sum;
    glm::vec3 left(1);
    float a = 0;
    for (int k = 0; k < kSteps; ++k) {
        const float part = static_cast<float>(k + 1) / kSteps, b = length * part * part, t = 0.5f * (a + b);
        const float radius = std::sqrt(nearest2 + (along + t) * (along + t)), up = radius - kPlanetRadius;
        const AirDensity density = airDensity(up);
        const glm::vec3 lost = extinction(density), after = glm::exp(-lost * (b - a));
        const glm::vec3 scattering = kRayleigh * density.rayleigh + glm::vec3(kHazeScattering * density.haze);
        const glm::vec3 seen = left * scattering * (1.0f - after) / lost;
        sum.light += seen * tables.directAt(up, lightSine(t, radius)) / (4 * std::numbers::pi_v<float>);
        sum.share += seen;
        left *= after;
        a = b;
    }
    if (hitsGround) {
        const float sine = lightSine(length, kPlanetRadius);
        sum.light += left * (kGroundAlbedo / std::numbers::pi_v<float> * std::max(sine, 0.0f)) *
                     tables.directAt(0, sine);
    }
    return sum;
}

// Each further scattering keeps the same share of light: a geometric series.
glm::vec3 Tables::scattered(float altitude, float sine) const {
    constexpr int kRings = 8, kAzimuths = 4;
    const glm::vec3 toLight(std::sqrt(std::max(1 - sine * sine, 0.0f)), 0, sine);
    Gathered mean;
    for (int ring = 0; ring < kRings; ++ring) {
        const float up = (2 * static_cast<float>(ring) + 1) / kRings - 1, level = std::sqrt(1 - up * up);
        for (int k = 0; k < kAzimuths; ++k) {
            const float azimuth = std::numbers::pi_v<float> * (static_cast<float>(k) + 0.5f) / kAzimuths;
            const Gathered g =
                gather(*this, altitude, {level * std::cos(azimuth), level * std::sin(azimuth), up}, toLight);
            mean.light += g.light / static_cast<float>(kRings * kAzimuths);
            mean.share += g.share / static_cast<float>(kRings * kAzimuths);
        }
    }
    return mean.light / (1.0f - mean.share);
}

Tables::Tables() {
    for (int row = 0; row < kAltitudes; ++row) {
        const float altitude = altitudeOf(row, kAltitudes), horizon = horizonSine(altitude);
        for (int column = 0; column < kSines; ++column) {
            const float root = static_cast<float>(column) / (kSines - 1);
            // Just over the horizon, so that rounding does not hide the light.
            const float sine = std::min(horizon + (1 - horizon) * root * root + 1e-5f, 1.0f);
            direct.at(column, row) = transmittanceToSpace(altitude, sine);
        }
    }
    for (int row = 0; row < kAroundAltitudes; ++row) {
        for (int column = 0; column < kAroundSines; ++column) {
            const float sine =
                kLowestSine + (1 - kLowestSine) * static_cast<float>(column) / (kAroundSines - 1);
            around.at(column, row) = scattered(altitudeOf(row, kAroundAltitudes), sine);
        }
    }
}

}  // namespace

AirLight airLight(float altitude, float sine) {
    static const Tables tables;
    return {tables.directAt(altitude, sine), tables.aroundAt(altitude, sine)};
}

}  // namespace terrane::world
