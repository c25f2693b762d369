// Clouds on a plane high above sea level, seen from below and from above. Needs frame_uniforms.glsl and sky_color.glsl;
// the texture of SkyNoise is bound.

layout(binding = kSkyNoiseUnit) uniform sampler2D cloudNoise;

const float kCloudTile = 4096.0;     // blocks: clouds repeat after that, as 256 chunks do
const float kCloudShown = 0.92;      // of what is behind a cloud, at most

// Blocks from the camera up to the plane; below 0 above it.
float cloudRise() {
    return air.levels.y - frame.cameraPosition.z;
}

// Place of a point of the plane in tiles.
vec2 cloudPlace(vec2 blocks) {
    return (blocks + kWind * frame.timeSeconds) / kCloudTile;
}

// Thickness at a place of the plane: large shapes with ragged edges.
float cloudThickness(vec2 at) {
    float shape = texture(cloudNoise, at).r * 0.62 + texture(cloudNoise, at * 4.0 + 0.37).g * 0.26 +
                  texture(cloudNoise, at * 16.0 + 0.11).g * 0.12;
    return smoothstep(0.50, 0.80, shape);
}

vec2 cloudCamera() {
    return frame.cameraPosition.xy + vec2((frame.cameraChunk & 255) * int(kChunkSize));
}

// Color and coverage in front of a sky color. The lit and the shaded side of a cloud depend on whether it is thinner or
// thicker toward the sun. A low sun lights it from below, a high one from above. Close to the plane its clouds give way
// to the cloud around the camera: clouds.frag.glsl.
vec4 clouds(vec3 direction, vec3 sky) {
    float rise = cloudRise(), ahead = rise < 0.0 ? -direction.z : direction.z;
    float up = max(ahead, 0.02);
    vec2 at = cloudPlace(cloudCamera() + direction.xy * (abs(rise) / up));
    float here = cloudThickness(at);
    float low = 1.0 - smoothstep(0.05, 0.4, frame.lightDirection.z);
    vec2 toLight = frame.lightDirection.xy / max(frame.lightDirection.z, 0.35);
    float there = texture(cloudNoise, at + toLight * 0.006).r;
    float shaded = rise < 0.0 ? -0.20 : 0.30 * (1.0 - low);
    float lit = clamp(0.62 + 2.4 * (texture(cloudNoise, at).r - there) - shaded * here, 0.0, 1.0);
    float through = max(dot(direction, frame.lightDirection.xyz), 0.0);
    float silver = pow(through, 24.0) * (1.0 - here);
    vec3 shade = 0.45 * frame.horizonColor.rgb + 0.3 * frame.ambientColor.rgb;
    vec3 glow = frame.glowColor.rgb * (0.25 + 0.5 * low) * through;
    vec3 color = shade + frame.lightColor.rgb * ((0.55 + 0.3 * low) * lit + 0.8 * silver) + glow;
    float coverage = here * smoothstep(0.03, 0.22, ahead) * smoothstep(0.0, kCloudDepth, abs(rise));
    return vec4(mix(sky, color, smoothstep(0.02, 0.35, ahead)), coverage);
}
