// Light that the land around the camera leaves, up to the horizon (shared/land.h). LAND: 1 if its textures exist
// (land_textures.h), 0 otherwise. Needs frame_uniforms.glsl.
struct Land {
    vec4 ground;  // red, green, blue: its color, linear; alpha: visible share of the sky
    float share;  // of the sun's or moon's disc that land does not hide
};

const Land kOpenLand = Land(vec4(0.12, 0.16, 0.07, 1.0), 1.0);  // if no level has the place

#if LAND == 1
#include "terrane/shared/land.h"

layout(std140, binding = kLandBinding) uniform LandBlock {
    LandFrame landFrame;
};
layout(binding = kLandShadowUnit) uniform sampler2DArray landShadows;
layout(binding = kLandGroundUnit) uniform sampler2DArray landGrounds;

// Texture coordinates and layer of the finest level that has the place; layer -1 for none. One level is enough: at its
// border it has the values of the next one.
vec3 landPlace(vec2 place) {
    vec3 found = vec3(0.5, 0.5, -1.0);
    for (int k = int(kLandLevels) - 1; k >= 0; --k) {
        vec4 level = landFrame.levels[k];
        vec2 at = level.xy + place * level.z, away = abs(at - 0.5);
        found = max(away.x, away.y) < 0.5 * kLandUsed * level.w ? vec3(at, float(k)) : found;
    }
    return found;
}

Land landAt(vec3 position) {
    vec3 at = landPlace(position.xy);
    vec4 ground = textureLod(landGrounds, at, 0.0);
    vec2 texel = textureLod(landShadows, at, 0.0).rg;
    float begin = landFrame.heights.x + landFrame.heights.y * texel.r, edge = kLandMaxEdge * texel.g;
    float share = clamp((position.z - begin) / max(edge, 0.01), 0.0, 1.0);
    if (at.z < 0.0) return kOpenLand;
    return Land(ground, share * share * (3.0 - 2.0 * share));
}
#else
Land landAt(vec3 position) {
    return kOpenLand;
}
#endif
