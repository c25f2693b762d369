// Water: waves in its normals, the sky in its mirror, darker and bluer the more of it one looks through. Needs
// frame_uniforms.glsl, sky_color.glsl, lighting.glsl.
layout(binding = kSkyNoiseUnit) uniform sampler2D noiseTexture;

// Positions repeat every 64 blocks, so that they are exact anywhere in the world.
vec2 wavePosition(vec3 position) {
    return position.xy + vec2((frame.cameraChunk & 3) * int(kChunkSize));
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

// Two patterns that move through each other; flatter with distance, where a pixel holds many waves.
vec3 waveNormal(vec3 position, vec3 toPoint) {
    float seconds = (frame.switches & kSwitchAnimation) != 0 ? frame.timeSeconds : 0.0;
    vec2 at = wavePosition(position);
    vec2 dx = stepOnWater(toPoint, frame.rayAcross.xyz * (2.0 / frame.viewportSize.x));
    vec2 dy = stepOnWater(toPoint, frame.rayUp.xyz * (2.0 / frame.viewportSize.y));
    vec2 slowAt = at / 32.0 + vec2(0.011, 0.007) * seconds;
    vec2 fastAt = turned(at) / 16.0 - vec2(0.031, -0.023) * seconds;
    vec2 slow = textureGrad(noiseTexture, slowAt, dx / 32.0, dy / 32.0).ba - 0.5;
    vec2 fast = textureGrad(noiseTexture, fastAt, turned(dx) / 16.0, turned(dy) / 16.0).ba - 0.5;
    float strength = 0.55 / (1.0 + 0.02 * length(toPoint));
    return normalize(vec3(strength * (slow + 0.6 * fast), 1.0));
}

// Light that comes back from within a thickness of water of a color, and the share of what lies behind it that is seen.
vec4 waterBody(vec3 color, vec3 lit, float blocks) {
    vec3 shallow = color * vec3(0.9, 1.1, 0.95) + vec3(0.0, 0.05, 0.03), deep = color * vec3(0.10, 0.28, 0.42);
    vec3 body = mix(shallow, deep, 1.0 - exp(-0.10 * blocks));
    return vec4(body * lit, exp(-0.22 * blocks));
}

// Schlick's approximation with the reflectance of water seen from above, 0.02.
float waterMirror(float facing) {
    return 0.02 + 0.98 * pow(1.0 - clamp(facing, 0.0, 1.0), 5.0);
}

// The share of daylight that is left under so much water: it loses a level a block.
float lightUnder(float blocks) {
    return brightnessOf(vec4(clamp(1.0 - blocks / 15.0, 0.0, 1.0))).a;
}

// Color times coverage, and coverage, of a surface of water before `blocks` of it. `levels`: of light; `shadow`: the
// share of direct light; `visibility`: that of light from all around. `hasFarFloor`: what lies behind belongs to a far tile, whose
// light knows nothing of the water.
vec4 shadeWater(Surface s, vec3 position, vec3 toPoint, float blocks, vec4 levels, float shadow, float visibility,
                bool hasFarFloor) {
    vec4 light = brightnessOf(levels);
    vec3 view = normalize(toPoint);
    bool isTop = abs(s.normal.z) > 0.5;
    vec3 normal = isTop ? waveNormal(position, toPoint) * sign(s.normal.z) : s.normal;
    vec3 direct = frame.lightColor.rgb * max(frame.lightDirection.z, 0.0) * shadow;
    vec3 lamps = light.rgb * (1.0 - frame.hiddenLampShare * light.a);
    vec3 lit = light.a * (frame.ambientColor.rgb * visibility + direct) + (lamps + kMinLight) * visibility;
    vec4 body = waterBody(s.albedo, lit, blocks);

    float mirror = isTop ? waterMirror(dot(-view, normal)) : 0.03;
    if (frame.isUnderWater != 0u) mirror = 0.0;
    vec3 reflected = reflect(view, normal);
    reflected.z = abs(reflected.z) + 0.01;
    reflected = normalize(reflected);
    float toLight = max(dot(reflected, frame.lightDirection.xyz), 0.0);
    vec3 glint = frame.discColor.rgb * smoothstep(0.9985, 0.9998, toLight) * shadow;
    vec3 sky = (skyColor(reflected) + glint) * light.a * light.a;
    float seen = hasFarFloor ? body.a * lightUnder(blocks * abs(view.z)) : body.a;
    float coverage = 1.0 - (1.0 - mirror) * seen;
    return vec4(mix(body.rgb * (1.0 - body.a), sky, mirror), coverage);
}
