// The sky: light that the air scatters toward an eye near the ground. Pure functions, any thread; the first
// call makes tables of the air in some 15 ms.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace terrane::world {

constexpr float kEyeAltitude =
    100;  // blocks over the sea: the sky is as seen from there, wherever the camera is

// The share of the light of the sun or moon that reaches the eye, by the sine of its elevation. At the
// horizon it fades with the visible part of a disc of the radius kDiscFade.
glm::vec3 directLight(float sine);
constexpr float kDiscFade = 0.055f;  // radians

// Radiance of the sky in a direction (unit length, z ≥ 0), lit by a light of irradiance 1 on a surface that
// faces it, in the direction `toLight` (unit length).
glm::vec3 skyRadiance(glm::vec3 direction, glm::vec3 toLight);

// Irradiance of level ground from the sky alone, for the same light.
glm::vec3 skyIrradiance(float sine);

// Radiance over the upper half of the sky for one elevation of the light. Columns: azimuth to the light,
// equal steps of sin(azimuth / 2), 0 first. Rows: elevation, equal steps of the root of its sine, the horizon
// first. 64 × 32 × 12 bytes = 24 KiB, made in some 2 ms.
struct SkyTable {
    static constexpr int kColumns = 64, kRows = 32;
    std::array<glm::vec3, std::size_t{kColumns} * kRows> radiance;
};
SkyTable skyTable(float sine);
// Bilinear; sky_color.glsl does the same.
glm::vec3 sampled(const SkyTable& table, glm::vec3 direction, glm::vec3 toLight);

}  // namespace terrane::world
