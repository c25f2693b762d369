// The color of the sky in a direction (unit length), without the disc of the sun or moon, clouds and stars. Also the
// color of distant fog and of reflections in water. Needs frame_uniforms.glsl. The table: SkyTexture.
#include "terrane/shared/air.h"

layout(std140, binding = kAirBinding) uniform AirBlock {
    AirFrame air;
};
layout(binding = kSkyTableUnit) uniform sampler2D skyTable;

vec3 skyColor(vec3 direction) {
    const vec2 kTexels = vec2(kSkyTableColumns, kSkyTableRows);
    float cosine = dot(direction.xy, air.lightAzimuth.xy) * inversesqrt(max(dot(direction.xy, direction.xy), 1e-8));
    vec2 at = sqrt(max(vec2(0.5 - 0.5 * cosine, direction.z), 0.0));
    vec3 color = textureLod(skyTable, at * ((kTexels - 1.0) / kTexels) + 0.5 / kTexels, 0.0).rgb;
    float away = 1.0 + air.aureole.w * (1.0 - dot(direction, frame.lightDirection.xyz));
    return color * air.lightAzimuth.z + air.aureole.rgb / (away * away);
}

// Color of empty water: bluer and darker with the blocks of water above.
vec3 murk() {
    vec3 fromAbove = exp(-vec3(0.10, 0.055, 0.035) * float(max(int(frame.waterAbove) - 1, 0)));
    return vec3(0.02, 0.13, 0.19) * fromAbove * (frame.ambientColor.rgb + 0.6 * frame.lightColor.rgb) + 0.002;
}

// From within water the sky is visible through a round window above (Snell's window); outside of it the surface
// reflects the water.
vec3 throughWindow(vec3 sky, vec3 direction) {
    return mix(murk(), sky, 0.8 * smoothstep(0.5, 0.8, direction.z));
}
