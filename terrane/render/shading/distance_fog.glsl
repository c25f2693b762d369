// Changes of colors with distance. Needs frame_uniforms.glsl and sky_color.glsl. UNDER_WATER: 1 if the camera is.

#include "terrane/render/water/caustics.glsl"
#if UNDER_WATER == 1
#include "terrane/render/shading/underwater.glsl"

vec4 throughAir(vec3 color, vec3 toPoint, float daylight) {
    return seenUnderWater(color, toPoint, daylight);
}

vec3 throughAirToSky(vec3 color, vec3 toPoint, float daylight) {
    return seenUnderWater(color, toPoint, daylight).rgb;
}
#else
const float kLog2E = 1.442695;

// Optical depth of the air for each color, in powers of ½ (world/sky/air.h). Molecules have half as much for red as for
// green and a fifth as much as for blue. Haze is equal for all colors: its mean density on the way is the integral of
// its exponential density in closed form (C. Wenzel, Real-time Atmospheric Effects in Games, 2006), and constant on the
// part of the way below its floor. `share2`: square of the share of the view's distance.
vec3 airDepth(vec3 toPoint, float blocks, float share2) {
    float camera = frame.cameraPosition.z - air.levels.x, below = max(-camera - toPoint.z, 0.0) - max(-camera, 0.0);
    float shareBelow = abs(toPoint.z) < 1e-3 ? float(camera < 0.0) : -below / toPoint.z;
    float rise = max((toPoint.z + below) * air.depth.z, -80.0);
    rise = abs(rise) < 1e-3 ? 1e-3 : rise;
    float haze = mix(air.depth.y * ((1.0 - exp2(-kLog2E * rise)) / rise), air.lightAzimuth.w, shareBelow);
    float molecules = air.depth.x * clamp(1.0 - toPoint.z * air.depth.w, 0.3, 1.7);
    // More near the end of the view, so that a short one has depth too.
    float end = 1.7 * share2 * share2;
    return (molecules * vec3(1.0, 2.0, 5.0) + haze) * blocks + end;
}

#include "terrane/render/shading/fading.glsl"

struct Seen {
    vec3 color;   // through the air
    vec3 behind;  // the sky there
    float left;   // coverage: 0 where chunks appear and vanish
};

// Blends toward the color of the sky behind, and from 5/6 of the view on toward nothing. Without daylight (0…1) there
// is no haze: caves stay dark.
Seen seenThroughAir(vec3 color, vec3 toPoint, float daylight) {
    float blocks2 = dot(toPoint, toPoint), inverse = inversesqrt(blocks2), blocks = blocks2 * inverse;
    float share2 = dot(toPoint.xy, toPoint.xy) / (frame.fogDistance * frame.fogDistance);
    vec3 depth = airDepth(toPoint, blocks, share2) * smoothstep(-0.1, 0.5, daylight);
    vec3 sky = skyColor(toPoint * inverse);
    float fading = fadingAt(toPoint, share2);
    bool isClear = (frame.switches & kSwitchDistanceFog) == 0;
    return Seen(isClear ? color : mix(sky, color, exp2(-depth)), sky, isClear ? 1.0 : 1.0 - fading);
}

// Premultiplied color, and coverage.
vec4 throughAir(vec3 color, vec3 toPoint, float daylight) {
    Seen seen = seenThroughAir(color, toPoint, daylight);
    return vec4(seen.color * seen.left, seen.left);
}

// The same blended over the sky without clouds, whose color is looked up once for both.
vec3 throughAirToSky(vec3 color, vec3 toPoint, float daylight) {
    Seen seen = seenThroughAir(color, toPoint, daylight);
    return mix(seen.behind, seen.color, seen.left);
}
#endif
