// ALPHA_CLASS: opaque or tested. MSAA_SAMPLES: above 1, holes are tested at each sample. SMOOTH: see block_texture.glsl.
// TINT: see block_tint.glsl.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/shared/hash.h"
#include "terrane/shared/quad.h"
#include "terrane/shared/shape_face.h"
#include "terrane/render/quads/packed_face.glsl"
#include "terrane/render/quads/block_texture.glsl"
#include "terrane/render/quads/block_tint.glsl"

layout(location = 0) in vec2 inTexel;
layout(location = 1) flat in uvec2 inFace;
layout(location = 0) out vec4 outSurface;

#if ALPHA_CLASS == ALPHA_TESTED && MSAA_SAMPLES > 1
// Without gl_SampleMask all samples that the triangle covers would be drawn. The nearest texel decides whether a sample
// is in a hole: a filter would read eight texels.
bool isHole(vec2 texel, int level) {
    return nearestTexel(inFace.x, texel, level).a < minAlpha(inFace.x);
}

// `seen`: the place to take the color from, the center of the pixel unless it is in a hole, which has no color of its
// own.
int samplesWithoutHole(int level, out vec2 seen) {
    int mask = 0;
    seen = inTexel;
    for (int k = 0; k < MSAA_SAMPLES; ++k) {
        vec2 texel = interpolateAtSample(inTexel, k);
        if (isHole(texel, level)) continue;
        mask |= 1 << k;
        seen = texel;
    }
    if (!isHole(inTexel, level)) seen = inTexel;
    return mask;
}
#endif

// The texture stays visible and sides differ, to keep orientation.
vec3 mergingColor(vec3 color, vec3 normal) {
    uint number = mixBits(inFace.y);
    vec3 own = 0.25 + 0.75 * vec3(number & 255u, number >> 8 & 255u, number >> 16 & 255u) / 255.0;
    float pattern = dot(color, vec3(0.3, 0.6, 0.1));
    float side = 0.75 + dot(normal, vec3(0.05, 0.1, 0.25));
    return own * side * (0.5 + 0.6 * pattern);
}

float glowOf(float alpha) {
    if (alphaModeOf(inFace.x) == kAlphaGlow) return alpha;
    return alphaModeOf(inFace.x) == kAlphaTestGlow ? clamp(2.0 * alpha - 1.0, 0.0, 1.0) : 0.0;
}

void main() {
    vec2 dx = dFdx(inTexel), dy = dFdy(inTexel), at = inTexel;
#if ALPHA_CLASS == ALPHA_TESTED && MSAA_SAMPLES > 1
    int mask = samplesWithoutHole(nearestLevel(dx, dy), at);
    if (mask == 0) discard;
    gl_SampleMask[0] = mask;
#endif
    vec4 texel = blockTexture(inFace.x, at, dx, dy);
#if ALPHA_CLASS == ALPHA_TESTED && MSAA_SAMPLES == 1
    if (texel.a < minAlpha(inFace.x)) discard;
#endif
    uint direction = directionOfFace(inFace.x);
    if (!gl_FrontFacing && direction < kDirectionPlant) direction ^= 1u;
    vec3 color = tintedColor(inFace.x, texel);
    if (frame.view == kViewMerging) color = mergingColor(color, normalOf(direction));
    outSurface = packSurface(color, direction, glowOf(texel.a), isFarFace(inFace.x));
}
