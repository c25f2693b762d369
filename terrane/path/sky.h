// The sky, and the sun or moon, as a light of the path tracer: what a camera sees there, what it gives to
// surfaces, and directions to it by chance. Plain values; any thread may use them.
//
// The rasterizer shows the sky in one scale and lights by it in another, because both follow the eye's curve
// (world/sky/environment.h). So a camera sees the sky and the disc as the rasterizer draws them, and surfaces
// get its light: a level one under the open sky reflects albedo · Environment::ambientColor, and one that
// faces the sun albedo · Environment::lightColor.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <numbers>
#include <vector>

#include "terrane/shared/air.h"
#include "terrane/world/sky/environment.h"

namespace terrane::path {

constexpr float kPi = std::numbers::pi_v<float>;

// Of a linear color (ITU-R BT.709).
inline float luminance(glm::vec3 color) {
    return 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z;
}

struct Sky {
    world::SkyTable table;       // as a camera sees it
    glm::vec3 lightShare{1};     // by which it lights surfaces
    glm::vec3 toLight{0, 0, 1};  // sun or moon
    glm::vec3 aureole{0};        // narrow glow around it, which lights nothing
    float aureoleSharpness = 0;
    glm::vec3 discColor{0};         // as a camera sees it
    glm::vec3 discRadiance{0};      // that lights surfaces, equal over the disc; 0: there is none
    float discCosine = 1;           // of the disc's radius
    std::vector<float> cumulative;  // of the cells between the table's nodes, the last one is 1
};

// `air`: of the rasterizer, for the scale of the table and the glow.
Sky skyOf(const world::Environment& environment, const shared::AirFrame& air);
// Equal on all sides, without a sun; black: no sky.
Sky evenSky(glm::vec3 radiance);

// What a camera sees, without the disc. Below the horizon it is as at the horizon.
glm::vec3 seenSky(const Sky& sky, glm::vec3 direction);
// What surfaces get from there, without the disc.
glm::vec3 skyLight(const Sky& sky, glm::vec3 direction);

inline bool isInDisc(const Sky& sky, glm::vec3 direction) {
    return glm::vec3(direction).x * sky.toLight.x + direction.y * sky.toLight.y +
               direction.z * sky.toLight.z >
           sky.discCosine;
}

// Directions above the horizon, more where the sky is brighter. Densities are per steradian.
glm::vec3 sampleSky(const Sky& sky, glm::vec2 random);
float skyDensity(const Sky& sky, glm::vec3 direction);
// Directions in the disc, equally dense.
glm::vec3 sampleDisc(const Sky& sky, glm::vec2 random);
inline float discSolidAngle(const Sky& sky) {
    return 2 * kPi * (1 - sky.discCosine);
}

// Two directions that are perpendicular to `normal` and to each other.
struct Frame {
    glm::vec3 across, along;
};
Frame frameOf(glm::vec3 normal);

}  // namespace terrane::path
