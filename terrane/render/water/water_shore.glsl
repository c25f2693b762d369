// Shore effects: foam along the shore, and caustics on the ground below. Needs caustics.glsl, gbuffer_read.glsl
// and water_waves.glsl.

const float kShoreReach = 48.0;  // blocks from the camera: farther foam is thinner than a pixel

// 1 if an opaque surface seems to stand at a place of the water surface: the depth shows one up to three blocks in
// front.
float groundAt(vec4 clip) {
    vec2 screen = clip.xy / clip.w;
    float inFront = clip.w - blocksOfDepth(depthAt(ivec2((0.5 + 0.5 * screen) * frame.viewportSize), 0));
    bool isOutside = max(abs(screen.x), abs(screen.y)) >= 1.0;
    return !isOutside && inFront > 0.02 + 0.002 * clip.w && inFront < 3.0 ? 1.0 : 0.0;
}

// Share of foam, in a line that moves back and forth: where ground is within part of a block toward the camera, or
// behind shallow water. `noise`: 0…1.
float foamAt(vec3 position, vec3 toPoint, float blocks, float noise) {
    float away = length(toPoint);
    vec2 at = wavePosition(position);
    float tide = 0.5 + 0.5 * sin(0.9 * waveSeconds() + 6.2831853 / 32.0 * (at.x + 2.0 * at.y));
    float width = (0.12 + 0.3 * tide) * smoothstep(0.3, 0.65, noise) + 0.04;
    vec2 nearer = position.xy - width * toPoint.xy / max(length(toPoint.xy), 1e-3);
    float ground = groundAt(frame.viewProjection * vec4(nearer, position.z + 0.1, 1.0));
    float thin = 1.0 - smoothstep(0.5 * width, 1.2 * width, blocks);
    float share = max(ground, thin) * (0.35 + 0.65 * smoothstep(0.35, 0.6, noise));
    return 0.55 * share * (1.0 - smoothstep(0.5 * kShoreReach, kShoreReach, away));
}

// Brightness of the ground behind relative to that without waves. `lit`: share of daylight that reaches the surface.
float causticsBehind(vec3 position, vec3 toPoint, vec3 view, float blocks, float lit) {
    float below = min(blocks, 64.0) * abs(view.z), share = 1.0, away = length(toPoint);
    float strength = 1.8 * sunInWater() * lit * (1.0 - smoothstep(24.0, 60.0, away)) * exp(-0.2 * below) *
                     smoothstep(0.05, 0.6, below);
    vec3 ground = position + view * min(blocks, 64.0);
    share += strength * (caustics(causticsPlace(ground, below)) - kMeanCaustics);
    return max(share, 0.2);
}
