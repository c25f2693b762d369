// Waves in the normals of water: moving patterns of noise, and at sea a swell in the direction of the wind. Needs
// frame_uniforms.glsl. WATER_DETAIL: 1 adds the swell.

layout(binding = kSkyNoiseUnit) uniform sampler2D noiseTexture;

struct Waves {
    vec2 slope;      // of the normal: x and y over z
    float variance;  // of slopes smaller than a pixel
};

// Positions repeat every 64 blocks, so that they are exact anywhere in the world.
vec2 wavePosition(vec3 position) {
    return position.xy + vec2((frame.cameraChunk & 3) * int(kChunkSize));
}

float waveSeconds() {
    return (frame.switches & kSwitchAnimation) != 0 ? frame.timeSeconds : 0.0;
}

// Distance on a level water surface to the next pixel, whose ray differs by `rayStep`. Derivatives of the position
// would be wrong where neighboring pixels show other surfaces.
vec2 stepOnWater(vec3 toPoint, vec3 rayStep) {
    float ahead = dot(toPoint, frame.rayAhead.xyz), down = abs(toPoint.z) < 1e-3 ? 1e-3 : toPoint.z;
    return ahead * (rayStep.xy - toPoint.xy * (rayStep.z / down));
}

vec2 turned(vec2 v) {
    return vec2(v.x + v.y, v.x - v.y);
}

// Adds a wave with `count` periods along 64 blocks of each axis and this steepness. Its angular frequency is √(g k), as
// in deep water (G. B. Airy, Tides and Waves, 1845). Waves fade out toward a length of two pixels.
void addSwell(inout Waves waves, vec2 count, float steepness, vec2 at, vec2 dx, vec2 dy) {
    vec2 k = count * (6.2831853 / 64.0);
    vec2 over = vec2(dot(k, dx), dot(k, dy));
    float share = exp(-0.4 * dot(over, over));
    float phase = dot(k, at) + sqrt(9.81 * length(k)) * waveSeconds();
    waves.slope += normalize(k) * (steepness * share * cos(phase));
    waves.variance += 0.5 * steepness * steepness * (1.0 - share * share);
}

// `open`: 0 on calm shallow water … 1 at sea. Noise flattens with distance, where a pixel has many waves.
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
    // Around the wind, in groups that come and go.
    vec2 groups = 2.0 * open * textureGrad(noiseTexture, at / 64.0, dx / 64.0, dy / 64.0).rg;
    addSwell(waves, vec2(3.0, 1.0), 0.040 * groups.x, at, dx, dy);
    addSwell(waves, vec2(5.0, -2.0), 0.040 * groups.y, at, dx, dy);
    addSwell(waves, vec2(7.0, 6.0), 0.036 * groups.x, at, dx, dy);
    addSwell(waves, vec2(12.0, -5.0), 0.032 * groups.y, at, dx, dy);
    addSwell(waves, vec2(9.0, 13.0), 0.028 * groups.x, at, dx, dy);
#endif
    return waves;
}

#if WATER_DETAIL == 1
// Noise that repeats after 4 blocks: slopes of ripples in b and a, foam in r.
vec4 fineNoise(vec3 position) {
    return textureLod(noiseTexture, wavePosition(position) / 4.0 + vec2(0.13, 0.05) * waveSeconds(), 0.0);
}

// Ripples break sunlight into sparks. In the distance they only spread the slopes.
Waves withRipples(Waves waves, vec4 fine, vec3 toPoint) {
    float shown = 1.0 / (1.0 + 0.0025 * dot(toPoint, toPoint));
    return Waves(waves.slope + 0.45 * shown * (fine.ba - 0.5), waves.variance + 0.006 * (1.0 - shown * shown));
}
#endif
