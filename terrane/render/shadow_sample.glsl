// The share of the sun's or moon's light that no block stops. Needs frame_uniforms.glsl.
// SHADOW: 1 hard edges, 2 edges that widen with the distance of what casts them.
#include "terrane/shared/shadow.h"

layout(binding = kShadowUnit) uniform sampler2DArrayShadow shadowMaps;
#if SHADOW == 2
layout(binding = kShadowDepthsUnit) uniform sampler2DArray shadowDepths;
#endif
layout(std140, binding = kShadowBinding) uniform ShadowBlock {
    ShadowFrame shadows;
};

const float kBlendFrom = 0.9;  // of a cascade's reach: there it goes over into the next one

// 0 at the camera to 1 where the cascade ends.
float reachShare(uint cascade, vec4 position) {
    vec2 at = vec2(dot(shadows.toMap[3u * cascade], position), dot(shadows.toMap[3u * cascade + 1u], position));
    vec2 away = abs(at - shadows.windows[cascade].xy);
    return max(away.x, away.y) * shadows.windows[cascade].z;
}

// Of values of the cascades. Software renderers look up an array number by number.
float ofCascade(int cascade, vec3 values) {
    return cascade == 0 ? values.x : cascade == 1 ? values.y : values.z;
}
float alongRow(int cascade, uint row, vec4 position) {
    return dot(cascade == 0   ? shadows.toMap[row]
               : cascade == 1 ? shadows.toMap[3u + row]
                              : shadows.toMap[6u + row],
               position);
}

#if SHADOW == 2
// Half the width of the sun, seen from the ground, as a tangent: twice the true one, so that soft edges are seen at the
// height of a tree.
const float kSunSize = 0.01;
const int kTaps = 5;
const vec2 kTapPlaces[kTaps] = vec2[](vec2(0.0), vec2(0.85, 0.35), vec2(-0.35, 0.85), vec2(-0.85, -0.35), vec2(0.35, -0.85));

// Edges as wide as the sun makes them at the mean distance of what stops the light (Fernando, Percentage-Closer Soft Shadows,
// 2005), at least a texel and at most `texels.w` to each side.
float softShare(vec4 at, float texel) {
    float toUv = 1.0 / shadows.mapTexels, most = shadows.texels.w;
    float depthSum = 0.0, count = 0.0;
    for (int k = 0; k < kTaps; ++k) {
        float depth = texture(shadowDepths, vec3(at.xy + 0.7 * most * toUv * kTapPlaces[k], at.z)).r;
        float stops = step(at.w, depth);
        depthSum += stops * (depth - at.w);
        count += stops;
    }
    float blocks = kShadowRange * depthSum / max(count, 1.0);
    float radius = clamp(kSunSize * blocks / texel, 0.6, most) * toUv;
    float lit = 0.0;
    for (int k = 0; k < kTaps; ++k) lit += texture(shadowMaps, vec4(at.xy + radius * kTapPlaces[k], at.zw));
    return lit / float(kTaps);
}
#endif

// Each map is asked at a point moved off its surface along the normal, by as much as the texels that a filter reads reach
// through a surface so inclined: the surface does not shade itself.
float cascadeShare(int cascade, vec3 position, vec3 normal, float slope) {
    float texel = ofCascade(cascade, shadows.texels.xyz);
#if SHADOW == 2
    float texels = 2.2;
#else
    float texels = 1.5;
#endif
    vec4 moved = vec4(position + normal * (0.02 + texels * texel * slope), 1.0);
    float layer = ofCascade(cascade, vec3(shadows.windows[0].w, shadows.windows[1].w, shadows.windows[2].w));
    vec4 at = vec4(alongRow(cascade, 0u, moved), alongRow(cascade, 1u, moved), layer, alongRow(cascade, 2u, moved));
#if SHADOW == 2
    return softShare(at, texel);
#else
    return texture(shadowMaps, at);
#endif
}

// By the finest cascade that holds the point; by two where one goes over into the next. Loops, since software renderers run
// both sides of a branch.
float lightShare(vec3 position, vec3 normal, float distance) {
    float facing = max(dot(normal, frame.lightDirection.xyz), 0.0);
    float slope = sqrt(max(1.0 - facing * facing, 0.0));
    vec4 point = vec4(position, 1.0);
    vec3 reach = max(vec3(reachShare(0u, point), reachShare(1u, point), reachShare(2u, point)), distance / kShadowSight);
    int cascade = reach.x < 1.0 ? 0 : reach.y < 1.0 ? 1 : reach.z < 1.0 ? 2 : 3;
    float share = 0.0, left = shadows.strength;
    for (; cascade < 3 && left > 0.0; ++cascade) {
        float own = left * (1.0 - smoothstep(kBlendFrom, 1.0, ofCascade(cascade, reach)));
        if (own > 0.0) share += own * cascadeShare(cascade, position, normal, slope);
        left -= own;
    }
    float beyond = left;
#if LAND == 1
    for (; left > 0.0; left = 0.0) beyond = left * landShare(position);
#endif
    return 1.0 - shadows.strength + share + beyond;
}
