// Movement of plants, leaves and water. Everything repeats after 4,096 chunks, so that numbers stay small and images do
// not depend on the place in the world. Needs frame_uniforms.glsl.
#include "terrane/shared/hash.h"
#include "terrane/shared/material.h"

const float kTurn = 6.2831853;

// Distance from the camera, in blocks, at which water is still: its waves are smaller than a pixel, and it meets water
// beyond the chunks, which does not move, without a gap.
const float kStillFrom = 96.0;

// Height of the surface at the chunk's corner of lowest x and y, in wave heights; lowered by a third, so that waves
// rise less above it.
float nodeWave(ivec2 chunk, float seconds) {
    vec2 away = float(kChunkSize) * vec2(chunk - frame.cameraChunk) - frame.cameraPosition.xy;
    float share = 1.0 - smoothstep(0.6 * kStillFrom, kStillFrom, length(away));
    uvec2 node = uvec2(chunk) & 4095u;
    float phase = float(hash2(node.x, node.y, 77u) >> 8) / 16777216.0;
    return share * (sin(kTurn * (0.25 * seconds + phase)) - 1.0 / 3.0);
}

// Linear along x and y between the corners of chunks: quads of any size in one chunk meet at their edges.
float liquidWave(ivec2 chunk, vec2 inChunk, float seconds) {
    vec2 f = inChunk / float(kChunkSize);
    float low = mix(nodeWave(chunk, seconds), nodeWave(chunk + ivec2(1, 0), seconds), f.x);
    float high = mix(nodeWave(chunk + ivec2(0, 1), seconds), nodeWave(chunk + 1, seconds), f.x);
    return mix(low, high, f.y);
}

// `surface`: height of the corner on the surface of a liquid, as a share of its height; lower surfaces have lower
// waves. `top`: 1 at the upper end of upright planes. Each class of faces has its own kinds of movement (ALPHA_CLASS,
// see quad.vert.glsl): opaque faces stand still, only blended ones are liquid.
vec3 waveOffset(MaterialRecord material, float surface, ivec2 chunk, vec3 cell, vec3 inChunk, float top,
                float seconds) {
    uint animation = lookAnimation(material.look);
#if ALPHA_CLASS == ALPHA_TESTED
    vec2 base = vec2((chunk & 4095) * int(kChunkSize));
    if (animation == kAnimationTopWaves) {
        vec2 at = base + cell.xy;
        float sway = sin(kTurn * fract(0.3 * seconds + (at.x + at.y) / 8.0));
        float gust = sin(kTurn * fract(0.11 * seconds + (at.x - 0.5 * at.y) / 32.0));
        return vec3(0.09 * sway + 0.05 * gust, 0.07 * sway - 0.04 * gust, 0.0) * top;
    }
    if (animation == kAnimationWholeWaves) {
        vec3 at = vec3(base, 0.0) + inChunk;
        float a = sin(kTurn * fract(0.31 * seconds + (at.x + at.y + at.z) * 3.0 / 16.0));
        float b = sin(kTurn * fract(0.23 * seconds + (at.x - at.y + 2.0 * at.z) / 8.0));
        return 0.035 * vec3(a, b, a - b);
    }
#elif ALPHA_CLASS == ALPHA_BLENDED
    if (animation == kAnimationLiquidSurface && surface > 0.0) {
        return vec3(0.0, 0.0, surface * optionsWaveHeight(material.options) * liquidWave(chunk, inChunk.xy, seconds));
    }
#endif
    return vec3(0.0);
}
