// Stars and the Milky Way. Needs frame_uniforms.glsl; the texture of MilkyWay is bound.
#include "terrane/shared/hash.h"

layout(binding = kMilkyWayUnit) uniform sampler2D milkyWay;

// The sky turns once a day around an axis toward the north.
vec3 starDirection(vec3 direction) {
    float angle = 6.2831853 * frame.starTurn, s = sin(angle), c = cos(angle);
    return vec3(c * direction.x + s * direction.z, direction.y, c * direction.z - s * direction.x);
}

// At most one star in each cell of a grid on the faces of a cube, of random place, brightness and color.
// `share`: of cells with a star, in quarters.
vec3 stars(vec3 direction, float pixel, uint share) {
    vec3 size = abs(direction);
    float longest = max(size.x, max(size.y, size.z));
    uint face = longest == size.x ? 0u : longest == size.y ? 1u : 2u;
    vec3 d = direction / longest;
    vec2 on = (face == 0u ? d.yz : face == 1u ? d.zx : d.xy) * 48.0;
    uint side = face * 2u + uint((face == 0u ? d.x : face == 1u ? d.y : d.z) > 0.0);
    ivec2 cell = ivec2(floor(on));
    uint h = hash3(uint(cell.x), uint(cell.y), side, 5u);
    vec2 place = 0.2 + 0.6 * vec2(h >> 8 & 255u, h >> 16 & 255u) / 255.0;
    float distance = length(on - vec2(cell) - place) / 48.0;
    float bright = float(h >> 24) / 255.0;
    float radius = max(0.0011, 0.75 * pixel);
    float shape = clamp(1.0 - distance / radius, 0.0, 1.0) * (0.0011 / radius);
    float twinkle = 0.8 + 0.2 * sin(3.0 * frame.timeSeconds + 40.0 * bright);
    vec3 tint = mix(vec3(1.0, 0.82, 0.66), vec3(0.72, 0.82, 1.0), float(h >> 4 & 15u) / 15.0);
    float isThere = (h & 3u) < share ? 1.0 : 0.0;
    return tint * (isThere * shape * twinkle * (0.12 + 1.3 * bright * bright * bright));
}

// The band lies across the sky, tilted to the axis that it turns around.
vec3 milkyWayColor(vec3 direction) {
    const vec3 kPole = vec3(0.48, 0.6, 0.64), kMiddle = vec3(0.8, -0.45, -0.178125);
    vec3 middle = normalize(kMiddle), aside = cross(normalize(kPole), middle);
    float across = dot(direction, normalize(kPole)) / 0.6;
    float along = 0.5 + atan(dot(direction, aside), dot(direction, middle)) / 6.2831853;
    return textureLod(milkyWay, vec2(along, 0.5 + 0.5 * across), 0.0).rgb;
}

vec3 nightSky(vec3 direction, float pixel) {
    vec3 d = starDirection(direction), band = milkyWayColor(d);
    vec3 color = 0.2 * band + stars(d, pixel, 1u + uint(step(0.12, band.g)));
    return color * frame.starBrightness * smoothstep(0.0, 0.2, direction.z);
}
