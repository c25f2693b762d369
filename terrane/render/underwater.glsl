// What a camera in the water sees: colors that fade, light that waves bundle on the ground, shafts of it. Needs
// frame_uniforms.glsl and sky_color.glsl; the noise of SkyNoise bound. What costs runs in loops that go on under water alone:
// software renderers run what a branch leaves out.
layout(binding = kSkyNoiseUnit) uniform sampler2D bundleNoise;

// Light that waves bundle: bright lines where two moving patterns are equal, 0…1, in the mean kMeanBundle. `at`: of the water's
// surface, repeats after 64 blocks.
const float kMeanBundle = 0.2;
float bundledLight(vec2 at) {
    float seconds = (frame.switches & kSwitchAnimation) != 0 ? frame.timeSeconds : 0.0;
    float a = textureLod(bundleNoise, at / 16.0 + vec2(0.021, 0.013) * seconds, 2.5).r;
    float b = textureLod(bundleNoise, vec2(at.y, -at.x) / 16.0 - vec2(0.017, -0.023) * seconds, 2.5).r;
    float line = max(1.0 - 9.0 * abs(a - b), 0.0);
    return line * line;
}

// Where light that reaches a point, `position` from the corner of the camera's chunk, came through a surface so many blocks above.
// Water bends it toward the vertical.
vec2 bundlePlace(vec3 position, float above) {
    vec2 lean = 0.7 * frame.lightDirection.xy / max(frame.lightDirection.z, 0.35);
    return position.xy + vec2((frame.cameraChunk & 3) * int(kChunkSize)) + lean * above;
}

// How strong bundles and shafts are: by day, when the sun is up.
float sunInWater() {
    return frame.isMoon != 0u ? 0.0 : smoothstep(0.05, 0.3, frame.lightDirection.z);
}

// Of the light of day on the ground: some ways are brighter. Daylight loses a level of 15 a block.
float bundlesOnGround(vec3 position, float blocks, float daylight) {
    float share = 1.0;
    int count = frame.isUnderWater != 0u ? 1 : 0;
    for (int k = 0; k < count; ++k) {
        float strength = 2.2 * sunInWater() * daylight * (1.0 - smoothstep(12.0, 30.0, blocks));
        share += strength * (bundledLight(bundlePlace(position, -position.z)) - kMeanBundle);
    }
    return max(share, 0.0);
}

// The mean of bundles along the view, brighter toward the light.
float shafts(vec3 direction, float blocks) {
    float sum = 0.0, reach = min(blocks, 16.0);
    int count = frame.isUnderWater != 0u ? 6 : 0;
    for (int k = 0; k < count; ++k) {
        vec3 at = frame.cameraPosition.xyz + direction * (reach * (float(k) + 0.5) / 6.0);
        sum += bundledLight(bundlePlace(at, -at.z)) - kMeanBundle;
    }
    float toLight = 0.5 + 0.5 * dot(direction, frame.lightDirection.xyz);
    return sum / 6.0 * (reach / 16.0) * (0.4 + 1.6 * toLight * toLight);
}

vec4 seenUnderWater(vec3 color, vec3 toPoint, float daylight) {
    float blocks = length(toPoint);
    vec3 direction = toPoint / max(blocks, 1e-4);
    color *= bundlesOnGround(frame.cameraPosition.xyz + toPoint, blocks, daylight);
    vec3 left = exp(-vec3(0.16, 0.075, 0.06) * blocks);
    vec3 water = murk() * max(1.0 + 2.0 * sunInWater() * shafts(direction, blocks), 0.0);
    return vec4(mix(water, color, left), 1.0);
}
