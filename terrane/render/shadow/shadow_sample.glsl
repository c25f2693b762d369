// Share of the sun's or moon's light that no block stops. Needs frame_uniforms.glsl.
// SHADOW: hard edges, or soft ones, which widen with the distance to the caster.
#include "terrane/shared/shadow.h"

layout(binding = kShadowUnit) uniform sampler2DArrayShadow shadowMaps;
#if SHADOW == SHADOW_SOFT
layout(binding = kShadowDepthsUnit) uniform sampler2DArray shadowDepths;
#endif
layout(std140, binding = kShadowBinding) uniform ShadowBlock {
    ShadowFrame shadows;
};

// Share of a cascade's reach from which pixels begin to use the next cascade.
const float kChangeFrom = 0.9;

// Selects a value by cascade. Software renderers index arrays one pixel at a time.
float ofCascade(int cascade, vec3 values) {
    return cascade == 0 ? values.x : cascade == 1 ? values.y : values.z;
}
float alongRow(int cascade, uint row, vec4 position) {
    return dot(cascade == 0   ? shadows.toMap[row]
               : cascade == 1 ? shadows.toMap[3u + row]
                              : shadows.toMap[6u + row],
               position);
}

#if SHADOW == SHADOW_SOFT
// Half the angular width of the sun as a tangent: twice the real one, so that edges are soft at the height of a tree.
const float kSunSize = 0.01;
const float kMostEdge = 0.4;  // blocks
const int kTaps = 5;
const vec2 kTapPlaces[kTaps] = vec2[](vec2(0.0), vec2(0.85, 0.35), vec2(-0.35, 0.85), vec2(-0.85, -0.35), vec2(0.35, -0.85));

// Soft edges as wide as the sun makes them at the mean distance of the casters (Fernando, Percentage-Closer Soft
// Shadows, 2005), at most `texels.w` and kMostEdge to each side: wider filters would look past walls.
float softShare(vec4 at, float texel) {
    float toUv = 1.0 / shadows.mapTexels, most = min(shadows.texels.w, kMostEdge / texel);
    float depthSum = 0.0, count = 0.0;
    for (int k = 0; k < kTaps; ++k) {
        float depth = texture(shadowDepths, vec3(at.xy + 0.7 * most * toUv * kTapPlaces[k], at.z)).r;
        float stops = step(at.w, depth);
        depthSum += stops * (depth - at.w);
        count += stops;
    }
    float blocks = kShadowRange * depthSum / max(count, 1.0);
    float radius = min(kSunSize * blocks / texel, most) * toUv;
    float lit = 0.0;
    for (int k = 0; k < kTaps; ++k) lit += texture(shadowMaps, vec4(at.xy + radius * kTapPlaces[k], at.zw));
    return lit / float(kTaps);
}
#endif

// Samples a map at a point moved off its surface along the normal, by the depth that the filter's texels span on a
// surface of this slope, so that the surface does not shade itself.
float cascadeShare(int cascade, vec3 position, vec3 normal, float slope) {
    float texel = ofCascade(cascade, shadows.texels.xyz);
#if SHADOW == SHADOW_SOFT
    float texels = 2.2;
#else
    float texels = 1.5;
#endif
    vec4 moved = vec4(position + normal * (0.02 + texels * texel * slope), 1.0);
    float layer = ofCascade(cascade, shadows.layers.xyz);
    vec4 at = vec4(alongRow(cascade, 0u, moved), alongRow(cascade, 1u, moved), layer, alongRow(cascade, 2u, moved));
#if SHADOW == SHADOW_SOFT
    return softShare(at, texel);
#else
    return texture(shadowMaps, at);
#endif
}

// 0…1, spread evenly over neighboring pixels (J. Jimenez, Next Generation Post Processing in Call of Duty: Advanced
// Warfare, 2014).
float pixelNoise() {
    return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}

// Uses the finest cascade that reaches this distance, and the land beyond all. Faces that face away from the light are
// not sampled.
float lightShare(vec3 position, vec3 normal, float distance, float landShare) {
    float facing = dot(normal, frame.lightDirection.xyz), slope = sqrt(max(1.0 - facing * facing, 0.0));
    vec3 reach = distance * shadows.reach.xyz + (1.0 - kChangeFrom) * pixelNoise();
    int cascade = reach.x < 1.0 ? 0 : reach.y < 1.0 ? 1 : reach.z < 1.0 ? 2 : 3;
    float share = cascade == 3 ? landShare : 1.0;
    // Without light there are no maps: the values read may be NaN.
    bool isLit = shadows.strength > 0.0;
    if (isLit && facing > 0.0 && cascade < 3) share = cascadeShare(cascade, position, normal, slope);
    return isLit ? mix(1.0, share, shadows.strength) : 1.0;
}
