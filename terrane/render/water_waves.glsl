// Waves in the normals of water: patterns of noise that move through each other, and at sea a swell that goes with the wind.
// Needs frame_uniforms.glsl. WATER_DETAIL: 1 draws the swell.
#include "terrane/render/wind.glsl"

layout(binding = kSkyNoiseUnit) uniform sampler2D noiseTexture;

struct Waves {
    vec2 slope;      // of the normal: x and y over z
    float variance;  // of the slopes that a pixel holds and does not show
};

// Positions repeat every 64 blocks, so that they are exact anywhere in the world.
vec2 wavePosition(vec3 position) {
    return position.xy + vec2((frame.cameraChunk & 3) * int(kChunkSize));
}

float waveSeconds() {
    return (frame.switches & kSwitchAnimation) != 0 ? frame.timeSeconds : 0.0;
}

// How far it is over level water from one pixel to the next, whose rays differ so: pixels beside may show other things, so
// their positions do not tell.
vec2 stepOnWater(vec3 toPoint, vec3 rayStep) {
    float ahead = dot(toPoint, frame.rayAhead.xyz), down = abs(toPoint.z) < 1e-3 ? 1e-3 : toPoint.z;
    return ahead * (rayStep.xy - toPoint.xy * (rayStep.z / down));
}

vec2 turned(vec2 v) {
    return vec2(v.x + v.y, v.x - v.y);
}

// A wave of `count` waves along 64 blocks of each axis, as steep as `steepness`; waves in deep water run by the square root of
// their wave number (G. B. Airy, Tides and Waves, 1845). A pixel that holds more than half a wave shows none of it.
void addSwell(inout Waves waves, vec2 count, float steepness, vec2 at, vec2 dx, vec2 dy) {
    vec2 k = count * (6.2831853 / 64.0);
    vec2 over = vec2(dot(k, dx), dot(k, dy));
    float share = exp(-0.4 * dot(over, over));
    float phase = dot(k, at) + sqrt(9.81 * length(k)) * waveSeconds();
    waves.slope += normalize(k) * (steepness * share * cos(phase));
    waves.variance += 0.5 * steepness * steepness * (1.0 - share * share);
}

// `open`: 0 on calm shallow water … 1 at sea. Noise gets flatter with distance, where a pixel holds many of its waves.
Waves wavesAt(vec3 position, vec3 toPoint, float open) {
    vec2 at = wavePosition(position);
    vec2 dx = stepOnWater(toPoint, frame.rayAcross.xyz * (2.0 / frame.viewportSize.x));
    vec2 dy = stepOnWater(toPoint, frame.rayUp.xyz * (2.0 / frame.viewportSize.y));
    vec2 slowAt = at / 32.0 + vec2(0.011, 0.007) * waveSeconds();
    vec2 fastAt = turned(at) / 16.0 - vec2(0.031, -0.023) * waveSeconds();
    vec2 slow = textureGrad(noiseTexture, slowAt, dx / 32.0, dy / 32.0).ba - 0.5;
    vec2 fast = textureGrad(noiseTexture, fastAt, turned(dx) / 16.0, turned(dy) / 16.0).ba - 0.5;
    float height = mix(0.28, 0.55, open), shown = 1.0 / (1.0 + 0.02 * length(toPoint));
    Waves waves = Waves(height * shown * (slow + 0.6 * fast), 0.0015 + 0.06 * height * height * (1.0 - shown * shown));
#if WATER_DETAIL == 1
    addSwell(waves, vec2(4.0, 1.0), 0.050 * open, at, dx, dy);
    addSwell(waves, vec2(7.0, 4.0), 0.045 * open, at, dx, dy);
    addSwell(waves, vec2(12.0, 3.0), 0.040 * open, at, dx, dy);
#endif
    return waves;
}

#if WATER_DETAIL == 1
// Noise that repeats after 4 blocks: slopes of ripples in b and a, foam in r.
vec4 fineNoise(vec3 position) {
    return textureLod(noiseTexture, wavePosition(position) / 4.0 + vec2(0.13, 0.05) * waveSeconds(), 0.0);
}

// Ripples break the light of the sun into sparks. With distance they spread slopes instead.
Waves withRipples(Waves waves, vec4 fine, vec3 toPoint) {
    float shown = 1.0 / (1.0 + 0.0025 * dot(toPoint, toPoint));
    return Waves(waves.slope + 0.45 * shown * (fine.ba - 0.5), waves.variance + 0.006 * (1.0 - shown * shown));
}
#endif
