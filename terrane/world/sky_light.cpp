#include "terrane/world/sky_light.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "terrane/world/air_tables.h"

namespace terrane::world {
namespace {

constexpr int kSteps = 24;  // along a line of sight

// A step on a line of sight: what it scatters does not depend on the azimuth.
struct Step {
    float along;         // blocks from the eye to its middle
    float altitude;      // of its middle
    glm::vec3 rayleigh;  // share of light there that reaches the eye, scattered by molecules
    glm::vec3 haze;      // by haze
};
using Line = std::array<Step, kSteps>;

// Within a step the light falls off as in even air (Hillaire 2020, section 5.3).
Line lineOfSight(float sine) {
    const float from = kPlanetRadius + kEyeAltitude, top = kPlanetRadius + kAirTop;
    const float start = from * sine, nearest2 = from * from * (1 - sine * sine);
    const float length = std::sqrt(top * top - nearest2) - start;
    Line line;
    glm::vec3 left(1);
    float a = 0;
    for (int k = 0; k < kSteps; ++k) {
        const float share = static_cast<float>(k + 1) / kSteps, b = length * share * share * share;
        Step& s = line[static_cast<std::size_t>(k)];
        s.along = 0.5f * (a + b);
        const float middle = start + s.along;
        s.altitude = std::sqrt(nearest2 + middle * middle) - kPlanetRadius;
        const AirDensity density = airDensity(s.altitude);
        const glm::vec3 lost = extinction(density), after = glm::exp(-lost * (b - a));
        const glm::vec3 seen = left * (1.0f - after) / lost;
        s.rayleigh = kRayleigh * density.rayleigh * seen;
        s.haze = kHazeScattering * density.haze * seen;
        left *= after;
        a = b;
    }
    return line;
}

glm::vec3 radianceAlong(const Line& line, glm::vec3 direction, glm::vec3 toLight) {
    const float cosine = glm::dot(direction, toLight);
    const float rayleigh = rayleighPhase(cosine), haze = hazePhase(cosine);
    const float from = kPlanetRadius + kEyeAltitude;
    glm::vec3 sum(0);
    for (const Step& s : line) {
        // The upward direction turns on the way: far toward the light it stands higher.
        const float sine = (from * toLight.z + s.along * cosine) / (kPlanetRadius + s.altitude);
        const AirLight light = airLight(s.altitude, sine);
        sum += light.direct * (s.rayleigh * rayleigh + s.haze * haze) + light.around * (s.rayleigh + s.haze);
    }
    return sum;
}

glm::vec3 directionOf(float sine, float azimuth) {
    const float level = std::sqrt(1 - sine * sine);
    return {level * std::cos(azimuth), level * std::sin(azimuth), sine};
}

glm::vec3 integratedIrradiance(float lightSine) {
    constexpr int kAzimuths = 8, kRings = 8;
    const glm::vec3 toLight = directionOf(lightSine, 0);
    glm::vec3 sum(0);
    for (int ring = 0; ring < kRings; ++ring) {
        // Rings of equal share of the irradiance: equal steps of sine².
        const float sine = std::sqrt((static_cast<float>(ring) + 0.5f) / kRings);
        const Line line = lineOfSight(sine);
        for (int k = 0; k < kAzimuths; ++k) {
            const float azimuth = std::numbers::pi_v<float> * (static_cast<float>(k) + 0.5f) / kAzimuths;
            sum += radianceAlong(line, directionOf(sine, azimuth), toLight);
        }
    }
    return std::numbers::pi_v<float> / (kAzimuths * kRings) * sum;
}

// By the sine of the light's elevation, from kLowest up.
struct IrradianceTable {
    static constexpr int kEntries = 96;
    static constexpr float kLowest = -0.35f;
    std::array<glm::vec3, kEntries> entries;

    IrradianceTable() {
        for (int k = 0; k < kEntries; ++k) {
            const float t = static_cast<float>(k) / (kEntries - 1);
            entries[static_cast<std::size_t>(k)] = integratedIrradiance(kLowest + (1 - kLowest) * t);
        }
    }
};

}  // namespace

glm::vec3 directLight(float sine) {
    const float above = glm::smoothstep(-kDiscFade, kDiscFade, sine);
    return airLight(kEyeAltitude, std::max(sine, 0.0f)).direct * above;
}

glm::vec3 skyRadiance(glm::vec3 direction, glm::vec3 toLight) {
    assert(direction.z >= 0 && "the sky is above the horizon");
    return radianceAlong(lineOfSight(direction.z), direction, toLight);
}

glm::vec3 skyIrradiance(float sine) {
    static const IrradianceTable table;
    const float at =
        glm::clamp((sine - IrradianceTable::kLowest) / (1 - IrradianceTable::kLowest), 0.0f, 1.0f) *
        (IrradianceTable::kEntries - 1);
    const int k = std::min(static_cast<int>(at), IrradianceTable::kEntries - 2);
    return glm::mix(table.entries[static_cast<std::size_t>(k)],
                    table.entries[static_cast<std::size_t>(k) + 1], at - static_cast<float>(k));
}

SkyTable skyTable(float sine) {
    SkyTable table;
    const glm::vec3 toLight = directionOf(sine, 0);
    for (int row = 0; row < SkyTable::kRows; ++row) {
        const float root = static_cast<float>(row) / (SkyTable::kRows - 1), up = root * root;
        const Line line = lineOfSight(up);
        for (int column = 0; column < SkyTable::kColumns; ++column) {
            const float half = static_cast<float>(column) / (SkyTable::kColumns - 1);
            const glm::vec3 direction = directionOf(up, 2 * std::asin(half));
            table.radiance[static_cast<std::size_t>(row * SkyTable::kColumns + column)] =
                radianceAlong(line, direction, toLight);
        }
    }
    return table;
}

glm::vec3 sampled(const SkyTable& table, glm::vec3 direction, glm::vec3 toLight) {
    const glm::vec2 a(direction), b(toLight);
    const float cosine = glm::dot(a, b) / std::max(glm::length(a) * glm::length(b), 1e-6f);
    const float x = std::sqrt(std::max(0.5f - 0.5f * cosine, 0.0f)) * (SkyTable::kColumns - 1);
    const float y = std::sqrt(std::max(direction.z, 0.0f)) * (SkyTable::kRows - 1);
    const int column = std::min(static_cast<int>(x), SkyTable::kColumns - 2);
    const int row = std::min(static_cast<int>(y), SkyTable::kRows - 2);
    const auto at = [&](int c, int r) {
        return table.radiance[static_cast<std::size_t>(r * SkyTable::kColumns + c)];
    };
    const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
    return glm::mix(glm::mix(at(column, row), at(column + 1, row), u),
                    glm::mix(at(column, row + 1), at(column + 1, row + 1), u), v);
}

}  // namespace terrane::world
