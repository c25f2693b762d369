// Distance by which the edges of opaque quads move outward, so that no sample falls between two of them
// (edge_expansion.glsl). Used by the renderer.
#pragma once

#include <glm/vec2.hpp>

namespace terrane::render {

// In pixels, for a rasterizer whose grid has 2^subpixelBits steps a pixel.
float edgeExpansion(int subpixelBits, glm::ivec2 imageSize);

}  // namespace terrane::render
