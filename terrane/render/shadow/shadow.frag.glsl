// ALPHA_CLASS: opaque or tested. The target has depth only.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/shared/quad.h"
#include "terrane/shared/shape_face.h"
#include "terrane/render/quads/packed_face.glsl"
#define SMOOTH 0
#define MSAA_SAMPLES 1
#include "terrane/render/quads/block_texture.glsl"

layout(location = 0) in vec2 inTexel;
layout(location = 1) flat in uvec2 inFace;

void main() {
#if ALPHA_CLASS == ALPHA_TESTED
    float alpha = nearestTexel(inFace.x, inTexel, nearestLevel(dFdx(inTexel), dFdy(inTexel))).a;
    if (alpha < minAlpha(inFace.x)) discard;
#endif
}
