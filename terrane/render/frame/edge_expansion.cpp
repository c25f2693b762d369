#include "terrane/render/frame/edge_expansion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace terrane::render {
namespace {

// Largest error of an edge that OpenGL 4.5 allows (docs/rendering.md, Cracks):
// - by the grid: corners are placed with SUBPIXEL_BITS bits (Implementation Dependent Values), so that each
//   coordinate is off by up to half a step and an edge by up to √½ steps;
// - by arithmetic: results are accurate to about one part in 10^5 (Floating-Point Computation); with
//   coordinates of half an image from its middle an edge is off by up to √½ · 10^-5 of the longer side.
// Two edges at one place meet if each moves by the sum. √2 times the sum is taken, since corners of nearly
// folded quads move less than that (kLongestMiter).
constexpr float kArithmeticError = 1e-5f;

}  // namespace

float edgeExpansion(int subpixelBits, glm::ivec2 imageSize) {
    assert(subpixelBits >= 0 && subpixelBits <= 24 && "a grid that floats can tell apart");
    const auto longerSide = static_cast<float>(std::max(imageSize.x, imageSize.y));
    return std::ldexp(1.0f, -subpixelBits) + kArithmeticError * longerSide;
}

}  // namespace terrane::render
