// How far the edges of opaque quads move outward, so that no sample falls between two of them
// (edge_expansion.glsl). Used by the renderer on the context's thread.
#pragma once

namespace terrane::render {

float edgeExpansion();  // pixels, of the current context's rasterizer

}  // namespace terrane::render
