// View of a camera in the water: fading colors, caustics on the ground, and shafts of light. Needs frame_uniforms.glsl,
// sky_color.glsl and caustics.glsl.

// Brightness of the ground relative to that without waves. Caustics fade with daylight, which loses a level of 15 a
// block.
float causticsOnGround(vec3 position, float blocks, float daylight) {
    float strength = 2.2 * sunInWater() * daylight * (1.0 - smoothstep(12.0, 30.0, blocks));
    return max(1.0 + strength * (caustics(causticsPlace(position, -position.z)) - kMeanCaustics), 0.0);
}

// Caustics along the view relative to their mean, brighter toward the light.
float shafts(vec3 direction, float blocks) {
    float sum = 0.0, reach = min(blocks, 16.0);
    for (int k = 0; k < 6; ++k) {
        vec3 at = frame.cameraPosition.xyz + direction * (reach * (float(k) + 0.5) / 6.0);
        sum += caustics(causticsPlace(at, -at.z)) - kMeanCaustics;
    }
    float toLight = 0.5 + 0.5 * dot(direction, frame.lightDirection.xyz);
    return sum / 6.0 * (reach / 16.0) * (0.4 + 1.6 * toLight * toLight);
}

// Nothing is visible beyond some thirty blocks.
vec4 seenUnderWater(vec3 color, vec3 toPoint, float daylight) {
    float blocks = length(toPoint);
    vec3 direction = toPoint / max(blocks, 1e-4);
    color *= causticsOnGround(frame.cameraPosition.xyz + toPoint, blocks, daylight);
    vec3 left = exp(-vec3(0.16, 0.075, 0.06) * blocks);
    vec3 water = murk() * max(1.0 + 2.0 * sunInWater() * shafts(direction, blocks), 0.0);
    return vec4(mix(water, color, left), 1.0);
}
