// Caustics: light that waves focus under water. Needs frame_uniforms.glsl; the texture of SkyNoise is bound.
layout(binding = kSkyNoiseUnit) uniform sampler2D causticsNoise;

// Bright lines where two moving patterns are equal, 0…1, with mean kMeanCaustics. `at`: place on the water's surface;
// repeats after 64 blocks.
const float kMeanCaustics = 0.2;
float caustics(vec2 at) {
    float seconds = (frame.switches & kSwitchAnimation) != 0 ? frame.timeSeconds : 0.0;
    float a = textureLod(causticsNoise, at / 16.0 + vec2(0.021, 0.013) * seconds, 2.0).r;
    float b = textureLod(causticsNoise, vec2(at.y, -at.x) / 16.0 - vec2(0.017, -0.023) * seconds, 2.0).r;
    float line = max(1.0 - 9.0 * abs(a - b), 0.0);
    return line * line;
}

// Place on the surface, `above` blocks higher, where light that reaches `position` enters the water. `position` is in
// blocks from the corner of the camera's chunk. Refraction makes the light steeper.
vec2 causticsPlace(vec3 position, float above) {
    vec2 lean = 0.7 * frame.lightDirection.xy / max(frame.lightDirection.z, 0.35);
    return position.xy + vec2((frame.cameraChunk & 3) * int(kChunkSize)) + lean * above;
}

// Strength of caustics and shafts: by day, when the sun is up.
float sunInWater() {
    return frame.isMoon != 0u ? 0.0 : smoothstep(0.05, 0.3, frame.lightDirection.z);
}
