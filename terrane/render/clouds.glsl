// Clouds on a plane high above the world, and stars. Needs frame_uniforms.glsl, sky_color.glsl; the noise of SkyNoise
// bound.
#include "terrane/shared/hash.h"
#include "terrane/render/wind.glsl"

layout(binding = kSkyNoiseUnit) uniform sampler2D cloudNoise;

const float kCloudHeight = 360.0;    // blocks
const float kCloudTile = 4096.0;     // blocks: clouds repeat after that, as 256 chunks do

// Thickness at a place of the plane in tiles: large shapes with ragged edges.
float cloudThickness(vec2 at) {
    float shape = texture(cloudNoise, at).r * 0.62 + texture(cloudNoise, at * 4.0 + 0.37).g * 0.26 +
                  texture(cloudNoise, at * 16.0 + 0.11).g * 0.12;
    return smoothstep(0.50, 0.80, shape);
}

// Color and coverage. Toward the sun a cloud is thinner or thicker than here: its lit and its shaded side.
vec4 clouds(vec3 direction) {
    float up = max(direction.z, 0.02);
    vec3 position = frame.cameraPosition.xyz;
    vec2 camera = position.xy + vec2((frame.cameraChunk & 255) * int(kChunkSize));
    vec2 blocks = camera + direction.xy * ((kCloudHeight - position.z) / up);
    vec2 at = (blocks + kWind * frame.timeSeconds) / kCloudTile;
    float here = cloudThickness(at);
    vec2 toLight = frame.lightDirection.xy / max(frame.lightDirection.z, 0.35);
    float there = texture(cloudNoise, at + toLight * 0.006).r;
    float lit = clamp(0.62 + 2.4 * (texture(cloudNoise, at).r - there) - 0.30 * here, 0.0, 1.0);
    float through = max(dot(direction, frame.lightDirection.xyz), 0.0);
    float silver = pow(through, 24.0) * (1.0 - here);
    vec3 shade = 0.55 * frame.horizonColor.rgb + 0.35 * frame.ambientColor.rgb;
    vec3 color = shade + frame.lightColor.rgb * (0.55 * lit + 0.8 * silver) + 0.25 * frame.glowColor.rgb * through;
    float coverage = here * smoothstep(0.03, 0.22, direction.z);
    return vec4(mix(skyColor(direction), color, smoothstep(0.02, 0.35, direction.z)), coverage);
}

// The sky turns once a day around an axis toward the north.
vec3 starDirection(vec3 direction) {
    float angle = 6.2831853 * frame.starTurn, s = sin(angle), c = cos(angle);
    return vec3(c * direction.x + s * direction.z, direction.y, c * direction.z - s * direction.x);
}

// At most one star in each cell of a grid on the faces of a cube, here and there, of different brightness and color.
vec3 stars(vec3 direction, float pixel) {
    vec3 size = abs(direction);
    float longest = max(size.x, max(size.y, size.z));
    uint face = longest == size.x ? 0u : longest == size.y ? 1u : 2u;
    vec3 d = direction / longest;
    vec2 on = (face == 0u ? d.yz : face == 1u ? d.zx : d.xy) * 48.0;
    uint side = face * 2u + uint((face == 0u ? d.x : face == 1u ? d.y : d.z) > 0.0);
    ivec2 cell = ivec2(floor(on));
    uint h = hash3(uint(cell.x), uint(cell.y), side, 5u);
    if ((h & 3u) != 0u) return vec3(0.0);
    vec2 place = 0.2 + 0.6 * vec2(h >> 8 & 255u, h >> 16 & 255u) / 255.0;
    float distance = length(on - vec2(cell) - place) / 48.0;
    float bright = float(h >> 24) / 255.0;
    float radius = max(0.0011, 0.75 * pixel);
    float shape = clamp(1.0 - distance / radius, 0.0, 1.0) * (0.0011 / radius);
    float twinkle = 0.8 + 0.2 * sin(3.0 * frame.timeSeconds + 40.0 * bright);
    vec3 tint = mix(vec3(1.0, 0.82, 0.66), vec3(0.72, 0.82, 1.0), float(h >> 4 & 15u) / 15.0);
    return tint * shape * twinkle * (0.12 + 1.3 * bright * bright * bright);
}
