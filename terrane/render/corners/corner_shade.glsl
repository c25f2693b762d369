// Shading at a corner (Shading::Corners). Between corners a fragment's display color is linear in its texel:
// texel · scale + added. That is exact for black and for the mean color of the texture. LIGHT, LAND, FAR: see
// light_sample.glsl, lighting.glsl. UNDER_WATER: 1 if the camera is.
#include "terrane/render/shading/light_sample.glsl"
#include "terrane/render/sky/sky_color.glsl"
#include "terrane/render/shading/distance_fog.glsl"
#include "terrane/render/shading/lighting.glsl"
#include "terrane/render/frame/tone.glsl"

// Air turns linear light into light · share + added.
struct Air {
    vec3 share, added;
};

Air airBefore(vec3 toPoint, float daylight) {
    vec3 added = throughAirToSky(vec3(0.0), toPoint, daylight);
    return Air(throughAirToSky(vec3(1.0), toPoint, daylight) - added, added);
}

// Scale of a texture with mean color `mean` (sRGB) on a surface that sends `light`. `added`: display color of the air.
vec3 scaleOf(vec3 mean, vec3 light, Air air, vec3 added) {
    return (displayColor(light * air.share + air.added) - added) / max(mean, 1.0 / 255.0);
}

vec3 lightOf(Surface s, vec4 levels) {
    return shade(s, litOf(s), kOpenLand, levels, 1.0, 1.0);
}
