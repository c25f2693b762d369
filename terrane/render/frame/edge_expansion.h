// The distance by which the edges of opaque quads move outward, so that no sample lies between two of them
// (edge_expansion.glsl). The renderer uses it.
#pragma once

#include <glm/vec2.hpp>

namespace terrane::render {

// Returns the distance in pixels, for a rasterizer whose grid has 2^subpixelBits steps a pixel.
float edgeExpansion(int subpixelBits, glm::ivec2 imageSize);

}  // namespace terrane::render
