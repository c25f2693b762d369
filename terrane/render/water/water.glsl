// Water: waves in its normals, reflections of sky and shore, glitter toward the sun or moon, darker and bluer with
// depth. Needs frame_uniforms.glsl, sky_color.glsl, lighting.glsl, caustics.glsl, gbuffer_read.glsl. WATER_DETAIL: 1
// adds reflections of the shore, foam and caustics.
#include "terrane/render/water/water_waves.glsl"
#if WATER_DETAIL == 1
#include "terrane/render/water/water_reflection.glsl"

// Shore effects: foam along the shore, and caustics on the ground below.
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
#endif

// Color that a layer adds, and the share of the background that it transmits.
struct Passed {
    vec4 color, through;
};

#include "terrane/render/water/water_body.glsl"

// Share of daylight left under so much water: it loses a level a block.
float lightUnder(float blocks) {
    return brightnessOf(vec4(clamp(1.0 - blocks / 15.0, 0.0, 1.0))).a;
}

// Reflection of the sun or moon in a rough surface whose slopes are normally distributed (C. Cox, W. Munk, Measurement
// of the Roughness of the Sea Surface from Photographs of the Sun's Glitter, 1954). Compressed smoothly below the
// brightness of the disc.
vec3 glitter(vec3 view, Waves waves) {
    vec3 toLight = frame.lightDirection.xyz, between = normalize(toLight - view);
    float up = max(between.z, 0.05), spread = waves.variance + 0.25 * frame.discSine * frame.discSine;
    vec2 off = between.xy / up - waves.slope;
    float share = exp(-dot(off, off) / spread) / spread;
    float up4 = up * up * up * up, steep = max(max(-view.z, toLight.z), 0.15);
    vec3 light = frame.lightColor.rgb * (0.25 * waterMirror(dot(-view, between)) * share / (steep * up4));
    vec3 most = 0.6 * frame.discColor.rgb;
    return light * most / (2.0 * light + most + 1e-6) * smoothstep(-0.02, 0.05, toLight.z);
}

// From below: the world above through a round window, outside of which the surface reflects the water (Snell's law).
Passed shadeFromBelow(vec3 view, vec3 normal) {
    float facing = clamp(dot(-view, normal), 0.0, 1.0), bent = 1.77 * (1.0 - facing * facing);
    float mirror = mix(waterMirror(sqrt(max(1.0 - bent, 0.0))), 1.0, smoothstep(0.9, 1.02, bent));
    return Passed(vec4(murk() * mirror * (0.8 + 0.7 * facing), mirror), vec4(1.0 - mirror));
}

// Shades a surface of water in front of `blocks` of water. `levels`: of light; `shadow`: the share of direct light;
// `visibility`: that of ambient light. `hasFarFloor`: the surface behind belongs to a far tile, whose light does not
// include the water. `isNearest`: no other layer is in front.
Passed shadeWater(Surface s, vec3 position, vec3 toPoint, float blocks, vec4 levels, float shadow, float visibility,
                  bool hasFarFloor, bool isNearest) {
    vec4 light = brightnessOf(levels);
    vec3 view = normalize(toPoint);
    bool isTop = abs(s.normal.z) > 0.5;
    float below = blocks * abs(view.z);
    Waves waves = wavesAt(position, toPoint, smoothstep(1.5, 8.0, below));
    vec3 normal = isTop ? normalize(vec3(waves.slope, 1.0)) * sign(s.normal.z) : s.normal;
#if UNDER_WATER == 1
    return shadeFromBelow(view, normal);
#else
    vec3 direct = frame.lightColor.rgb * max(frame.lightDirection.z, 0.0) * shadow;
    vec3 lamps = light.rgb * (1.0 - frame.hiddenLampShare * light.a);
    vec3 lit = light.a * (frame.ambientColor.rgb * visibility + direct) + (lamps + kMinLight) * visibility;
    vec3 seen = throughBody(blocks), body = waterBody(s.albedo, lit, blocks) * (1.0 - seen);
    float open = light.a * light.a, mirror = isTop ? waterMirror(dot(-view, normal)) : 0.03;
    mirror *= smoothstep(0.0, 0.2, blocks);  // no hard edge along the shore
    vec3 reflected = reflect(view, normal);
    reflected = normalize(vec3(reflected.xy, abs(reflected.z) + 0.01));
    vec3 mirrored = skyColor(reflected) * open;
    if (hasFarFloor) seen *= lightUnder(below);
#if WATER_DETAIL == 1
    // Calmer, so that a reflection stays in one piece: a pixel has one ray, not those of all its waves.
    vec3 calmer = normalize(vec3(0.07 * waves.slope, 1.0));
    vec4 shore = shoreReflection(position, reflect(view, calmer), isTop && isNearest ? mirror : 0.0);
    mirrored = mix(mirrored, shore.rgb, shore.a);
    seen *= causticsBehind(position, toPoint, view, blocks, shadow * light.a);
    vec4 fine = fineNoise(position);
    float foam = isTop ? foamAt(position, toPoint, blocks, fine.r) : 0.0;
    body = mix(body, 0.85 * lit, foam);
    seen *= 1.0 - foam;
    mirror *= 1.0 - foam;
    waves = withRipples(waves, fine, toPoint);
#endif
    vec3 glint = isTop ? glitter(view, waves) * shadow * open : vec3(0.0);
    float left = dot(seen, vec3(1.0 / 3.0)) * (1.0 - mirror);
    return Passed(vec4(mix(body, mirrored, mirror) + glint, 1.0 - left), vec4(seen * (1.0 - mirror), left));
#endif
}
