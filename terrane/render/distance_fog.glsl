// How distance changes colors. Needs frame_uniforms.glsl and sky_color.glsl. UNDER_WATER: 1 where the camera is.

#include "terrane/render/bundled_light.glsl"
#if UNDER_WATER == 1
#include "terrane/render/underwater.glsl"
#endif

// Toward the color of the sky behind, and from 5/6 of the view on toward nothing, so that chunks come and go unseen:
// color times what is left of it, and what is left. Where no daylight comes (0…1) there is no haze: caves stay dark.
vec4 throughAir(vec3 color, vec3 toPoint, float daylight) {
#if UNDER_WATER == 1
    return seenUnderWater(color, toPoint, daylight);
#else
    if ((frame.switches & kSwitchDistanceFog) == 0) return vec4(color, 1.0);
    float share = length(toPoint.xy) / frame.fogDistance;
    float haze = (1.0 - exp(-0.9 * share * share * share)) * smoothstep(-0.1, 0.5, daylight);
    vec3 direction = normalize(toPoint);
    direction.z = max(direction.z, 0.0);
    color = mix(color, skyColor(direction), haze);
    // Loaded chunks fill a square around the camera's.
    float border = max(abs(toPoint.x), abs(toPoint.y)) / frame.fogDistance;
    float left = 1.0 - smoothstep(5.0 / 6.0, 1.0, max(border, 0.85 * share));
    return vec4(color * left, left);
#endif
}
