// ALPHA_CLASS: 0 opaque, 1 tested. SAMPLES: above 1, holes are tested at each sample. SMOOTH: see block_texture.glsl.
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/shared/hash.h"
#include "terrane/shared/quad.h"
#include "terrane/shared/shape_face.h"
#include "terrane/render/face_word.glsl"
#include "terrane/render/block_texture.glsl"

layout(location = 0) in vec2 inTexel;
layout(location = 1) flat in uvec2 inFace;
layout(location = 0) out vec4 outSurface;

#if ALPHA_CLASS == 1 && SAMPLES > 1
// Without a gl_SampleMask all samples that the triangle covers would be drawn.
int samplesWithoutHole(vec2 dx, vec2 dy) {
    int mask = 0;
    for (int k = 0; k < SAMPLES; ++k) {
        float alpha = blockTexture(inFace.x, interpolateAtSample(inTexel, k), dx, dy).a;
        if (alpha >= leastAlpha(inFace.x)) mask |= 1 << k;
    }
    return mask;
}
#endif

// The texture stays visible and sides differ, so that one sees where one is.
vec3 aggregationColor(vec3 color, vec3 normal) {
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
    vec2 dx = dFdx(inTexel), dy = dFdy(inTexel);
    vec4 texel = blockTexture(inFace.x, inTexel, dx, dy);
#if ALPHA_CLASS == 1
#if SAMPLES > 1
    int mask = samplesWithoutHole(dx, dy);
    if (mask == 0) discard;
    gl_SampleMask[0] = mask;
#else
    if (texel.a < leastAlpha(inFace.x)) discard;
#endif
#endif
    uint direction = directionOfFace(inFace.x);
    if (!gl_FrontFacing && direction < kDirectionPlant) direction ^= 1u;
    vec3 color = texel.rgb;
    if (uint(frame.horizonColor.w) == kViewAggregation) color = aggregationColor(color, normalOf(direction));
    outSurface = packSurface(color, direction, glowOf(texel.a));
}
