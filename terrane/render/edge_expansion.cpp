#include "terrane/render/edge_expansion.h"

#include "terrane/gpu/handle.h"

namespace terrane::render {
namespace {

// A corner and an edge's ends are each off by up to √½ steps of the rasterizer's grid: two quads that both
// grow by √½ steps meet. Corners of folded quads grow less, so more is taken; with 2 steps of 1/256 pixel one
// in a hundred samples along an edge changes.
constexpr float kExpansionSteps = 2;

}  // namespace

float edgeExpansion() {
    GLint subpixelBits = 4;  // the least that OpenGL allows
    glGetIntegerv(GL_SUBPIXEL_BITS, &subpixelBits);
    return kExpansionSteps / static_cast<float>(1 << subpixelBits);
}

}  // namespace terrane::render
