// Shadows of land on land, for a distant light: one pass over a square of heights from the light's side on,
// each texel from the two nearest of the previous line. Pure functions; any thread.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace terrane::render {

// Shadow of a texel: points below `height` (blocks) are hidden from the light by land `distance` blocks away
// toward it.
struct LandShadow {
    float height, distance;
};
constexpr float kNoShadow = -1000.0f;  // blocks: below all land

struct LandHeights {
    int side = 0;  // texels
    float texelBlocks = 1;
    std::span<const float> blocks;  // row after row
};

// `direction`: to the light, unit length. `outside`: the shadow at a place beside the square, in texels; 0, 0
// is the middle of the first one. S(p) = max(H(q), S(q)) − |q − p| · tan(elevation), where q is the place on
// the previous line toward the light: the horizon as in Max, "Horizon mapping: shadows for bump-mapped
// surfaces", 1988, for one direction, in O(1) a texel.
void sweepShadows(const LandHeights& land, glm::vec3 direction,
                  const std::function<LandShadow(glm::vec2)>& outside, std::span<LandShadow> shadows);

// Computes the share of the sky that terrain forms of at least `minBlocks` leave visible, 0…1, row by row. It
// is 1 − the mean of sin² of the horizon's angle in eight directions.
void skyVisibility(const LandHeights& land, float minBlocks, std::span<float> visibility);

}  // namespace terrane::render
