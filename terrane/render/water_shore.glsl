// Where water meets the ground: foam along the shore, and light that waves bundle on the ground below. Needs bundled_light.glsl,
// gbuffer_read.glsl and water_waves.glsl.

const float kShoreReach = 48.0;  // blocks from the camera: beyond, foam is thinner than a pixel

// 1 where something opaque stands at a place of the surface, as far as the screen tells: seen no more than three blocks before it.
float groundAt(vec4 clip) {
    vec2 screen = clip.xy / clip.w;
    float inFront = clip.w - blocksOfDepth(depthAt(ivec2((0.5 + 0.5 * screen) * frame.viewportSize), 0));
    bool isOutside = max(abs(screen.x), abs(screen.y)) >= 1.0;
    return !isOutside && inFront > 0.02 + 0.002 * clip.w && inFront < 3.0 ? 1.0 : 0.0;
}

// The share of foam, in a line that comes and goes: within part of a block from ground at the four sides, or before ground that
// is seen through little water.
float foamAt(vec3 position, vec3 toPoint, float blocks) {
    float away = length(toPoint), sum = 0.0;
    vec2 at = wavePosition(position);
    float noise = textureLod(noiseTexture, at / 8.0 + 0.02 * kWind * waveSeconds(), 2.0).r;
    float tide = 0.5 + 0.5 * sin(0.9 * waveSeconds() + 40.0 * textureLod(noiseTexture, at / 64.0, 4.0).r);
    float width = (0.12 + 0.3 * tide) * smoothstep(0.3, 0.65, noise) + 0.04;
    vec4 clip = frame.viewProjection * vec4(position + vec3(0.0, 0.0, 0.1), 1.0);
    for (int k = 0; k < 4; ++k) {
        float side = (k & 1) == 0 ? width : -width;
        sum += groundAt(clip + side * frame.viewProjection[k >> 1]);
    }
    float thin = 1.0 - smoothstep(0.5 * width, 1.2 * width, blocks);
    float share = max(min(sum, 1.0), thin) * (0.35 + 0.65 * smoothstep(0.35, 0.6, noise));
    return 0.55 * share * (1.0 - smoothstep(0.5 * kShoreReach, kShoreReach, away));
}

// How much brighter the ground behind is than without waves. `lit`: the share of daylight that reaches the surface.
float bundlesBehind(vec3 position, vec3 toPoint, vec3 view, float blocks, float lit) {
    float below = min(blocks, 64.0) * abs(view.z), share = 1.0, away = length(toPoint);
    float strength = 1.8 * sunInWater() * lit * (1.0 - smoothstep(24.0, 60.0, away)) * exp(-0.2 * below) *
                     smoothstep(0.05, 0.6, below);
    vec3 ground = position + view * min(blocks, 64.0);
    share += strength * (bundledLight(bundlePlace(ground, below)) - kMeanBundle);
    return max(share, 0.2);
}
