#include "terrane/world/sky/air.h"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <numbers>

namespace terrane::world {
namespace {

// Absorption per block at the highest density: four times the Earth's, as means over the bands that screens
// show as red, green and blue. Single wavelengths (680, 550, 440 nm) would keep too much red and make
// twilight purple.
constexpr glm::vec3 kOzoneAbsorption{11e-6f, 9e-6f, 0.6e-6f};
constexpr float kOzoneAltitude = 6250, kOzoneHalfWidth = 3750;  // 25 km and 15 km, / 4

}  // namespace

AirDensity airDensity(float altitude) {
    return {std::exp(-altitude / kRayleighScale), std::exp(-altitude / kHazeScale),
            std::max(0.0f, 1 - std::abs(altitude - kOzoneAltitude) / kOzoneHalfWidth)};
}

glm::vec3 extinction(const AirDensity& density) {
    return kRayleigh * density.rayleigh + glm::vec3(kHazeExtinction * density.haze) +
           kOzoneAbsorption * density.ozone;
}

glm::vec3 transmittanceToSpace(float altitude, float sine) {
    constexpr int kSteps = 48;
    const float from = kPlanetRadius + altitude, top = kPlanetRadius + kAirTop;
    const float nearest2 = from * from * (1 - sine * sine);  // squared distance of the line from the centre
    if (sine < 0 && nearest2 < kPlanetRadius * kPlanetRadius) return glm::vec3(0);
    const float start = from * sine, length = std::sqrt(top * top - nearest2) - start;
    // A grazing line passes the densest air at its lowest point, others at their start: steps are short
    // there.
    const float lowest = std::clamp(-start / length, 0.0f, 1.0f);
    const auto place = [&](float share) {
        const float v = share - lowest, side = v < 0 ? lowest : 1 - lowest;
        return length * (lowest + v * std::abs(v) / std::max(side, 1e-6f));
    };
    glm::vec3 depth(0);
    for (int k = 0; k < kSteps; ++k) {
        const float a = place(static_cast<float>(k) / kSteps), b = place(static_cast<float>(k + 1) / kSteps);
        const float along = start + 0.5f * (a + b);
        depth += extinction(airDensity(std::sqrt(nearest2 + along * along) - kPlanetRadius)) * (b - a);
    }
    return glm::exp(-depth);
}

float rayleighPhase(float cosine) {
    return 3 / (16 * std::numbers::pi_v<float>)*(1 + cosine * cosine);
}

float hazePhase(float cosine) {
    constexpr float g = kHazeForward;
    const float base = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (4 * std::numbers::pi_v<float> * base * std::sqrt(base));
}

}  // namespace terrane::world
