// Light of an opaque surface that reaches the camera: premultiplied color, and coverage. SHADOW, OVER_SKY: see
// shade.frag.glsl.
// Needs lighting.glsl, distance_fog.glsl, gbuffer_read.glsl, and `inRay`.
#if SHADOW == SHADOW_RAYS
#include "terrane/render/rays/ray_shadow.glsl"
#elif SHADOW != SHADOW_NONE
#include "terrane/render/shadow/shadow_sample.glsl"
#endif

vec4 throughAirOf(vec3 color, vec3 toPoint, float daylight) {
#if OVER_SKY == 0
    return vec4(throughAirToSky(color, toPoint, daylight), 1.0);
#else
    return throughAir(color, toPoint, daylight);
#endif
}

vec4 shadeAt(Surface s, Lit lit, float depth, float visibility) {
    vec3 toPoint = inRay * blocksOfDepth(depth);
    vec3 position = frame.cameraPosition.xyz + toPoint;
    if ((frame.switches & kSwitchUnlit) != 0) return throughAirOf(s.albedo, toPoint, 1.0);
    Land land = landAt(position);
    float shadow = 1.0;
#if SHADOW != SHADOW_NONE
    shadow = lightShare(position, lit.normal, length(toPoint), land.share);
#endif
    vec4 levels = levelsAt(position, s);
    return throughAirOf(shade(s, lit, land, levels, shadow, visibility), toPoint, levels.a);
}
