// The light and the sky at a time of day: pure functions, any thread. Colors come from the model of the air
// (air.h); a response curve of the eye, which also works in twilight, converts them to screen colors.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

#include "terrane/world/sky/air.h"

namespace terrane::world {

// The light at a point of the air, by its altitude and the elevation of the light, for a light of irradiance
// 1 above the air. It comes from two tables that the first call makes in about 10 ms.
struct AirLight {
    glm::vec3 direct;  // irradiance of the light that is left there
    glm::vec3 around;  // mean radiance of light that was scattered at least once, from all sides
};
// Returns the light at an altitude, 0 … kAirTop. `sine` is that of the light's elevation there.
AirLight airLight(float altitude, float sine);

// The functions below compute the sky: light that the air scatters toward an eye near the ground. The first
// call makes tables of the air in about 15 ms.
constexpr float kEyeAltitude =
    100;  // blocks over the sea: the sky is as seen from there, wherever the camera is

// Returns the share of the light of the sun or moon that reaches the eye, by the sine of its elevation. At
// the horizon it fades with the visible part of a disc of the radius kDiscFade.
glm::vec3 directLight(float sine);
constexpr float kDiscFade = 0.055f;  // radians

// Returns the radiance of the sky in a direction (unit length, z ≥ 0), lit by a light of irradiance 1 on a
// surface that faces it, in the direction `toLight` (unit length).
glm::vec3 skyRadiance(glm::vec3 direction, glm::vec3 toLight);

// Returns the irradiance of level ground from the sky alone, for the same light.
glm::vec3 skyIrradiance(float sine);

// Radiance over the upper half of the sky for one elevation of the light. Columns: azimuth to the light,
// equal steps of sin(azimuth / 2), 0 first. Rows: elevation, equal steps of the root of its sine, the horizon
// first. 64 × 32 × 12 bytes = 24 KiB, made in some 2 ms.
struct SkyTable {
    static constexpr int kColumns = 64, kRows = 32;
    std::array<glm::vec3, std::size_t{kColumns} * kRows> radiance;
};
SkyTable skyTable(float sine);
// Samples the table bilinearly; sky_color.glsl does the same.
glm::vec3 sampled(const SkyTable& table, glm::vec3 direction, glm::vec3 toLight);

// Colors are linear; 1 is a white surface in full sunlight at noon, roughly.
struct Environment {
    glm::vec3 lightDirection;  // to the sun by day, to the moon at night; unit length
    glm::vec3 lightColor;      // 0 where the light is under the horizon
    glm::vec3 ambientColor;    // of a level surface under the open sky alone
    glm::vec3 zenithColor;     // of the sky straight above
    glm::vec3 horizonColor;    // of the sky near the horizon, mean of all sides
    glm::vec3 glowColor;       // added to the sky near the horizon under the light
    glm::vec3 discColor;       // of the sun or moon itself
    float discRadius;          // of the sun or moon, radians
    bool isMoon;               // the light is the moon
    float starTurn;            // of the stars around the sky, 0…1 a day
    float starLight;           // brightness of the stars, 0 by day … 1 at night
    float lampShare;           // of lamp light that full daylight hides, 0 at night … 0.8
};

// Returns the environment at a time of day: 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk. Only the fraction of
// `timeDay` counts.
Environment environmentAt(float timeDay);

// Returns the color of the sky in a direction (unit length, z ≥ 0), for the light's direction.
glm::vec3 skyColor(glm::vec3 direction, glm::vec3 toLight, bool isMoon);
// Returns the same for the whole sky, with the sine of the light's elevation, in about 2 ms.
SkyTable skyColorTable(float sine, bool isMoon);
// Returns the green of Environment::ambientColor for that light.
float ambientGreen(float sine, bool isMoon);

}  // namespace terrane::world
