// The light of a surface: lamps, sky, sun or moon. Needs frame_uniforms.glsl, packed_gbuffer.glsl, light_sample.glsl.
// FAR: 1 if all surfaces belong to far tiles.
#include "terrane/render/land/land_light.glsl"

const vec3 kMinLight = vec3(0.006);  // in the darkest cave: shapes are just visible

// Light levels in front of the surface. Plants stand inside their block and take its light. The position is computed
// from the depth, with an error below kOff within some hundred blocks: moved by kOff along the normal it is on the near
// side of the plane between two layers of nodes, everywhere on a face. Figures take the light of the block that they
// stand in too, from the layer of nodes that a face is in. Far tiles are under the open sky.
vec4 levelsAt(vec3 position, Surface s) {
#if FAR == 1
    return vec4(0.0, 0.0, 0.0, 1.0);
#else
    if (s.isFar) return vec4(0.0, 0.0, 0.0, 1.0);
    const float kOff = 1.0 / 256.0, kIntoFigure = -0.55;  // sampleLight() goes half a block ahead
    vec3 normal = s.direction == kDirectionPlant ? vec3(0.0) : normalOf(s.direction);
    return sampleLight(position + (s.isFigure ? kIntoFigure : kOff) * normal, normal);
#endif
}

// Brightness of a level, near level^0.85, so that half of all levels are useful.
vec4 brightnessOf(vec4 levels) {
    return mix(levels, sqrt(levels), 0.23);
}

// Light from the sky and from the ground, which sun and sky light: a face that looks down gets only that of the ground,
// one that looks aside half of each.
vec3 lightAround(Land land, vec3 normal) {
    float up = 0.5 + 0.5 * normal.z;
#if LAND == 1
    vec3 sky = frame.ambientColor.rgb * land.ground.a;
    vec3 sun = frame.lightColor.rgb * (max(frame.lightDirection.z, 0.0) * land.share);
    return mix(land.ground.rgb * (sun + sky), sky, up);
#else
    return frame.ambientColor.rgb * mix(frame.ambientFromBelow, 1.0, up);
#endif
}

// Surface as lit by the sun or moon.
struct Lit {
    vec3 albedo;  // times the cosine to the light
    vec3 normal;
};

Lit litOf(Surface s) {
    return Lit(s.albedo * max(dot(s.normal, frame.lightDirection.xyz), 0.0), s.normal);
}

// Sums lamps, hidden by day where daylight reaches; sky and ground; and the sun or moon where the sky is visible.
// `shadow` is the share of direct light, `visibility` that of ambient light.
vec3 shade(Surface s, Lit lit, Land land, vec4 levels, float shadow, float visibility) {
    vec4 light = brightnessOf(levels);
    vec3 lamps = light.rgb * (1.0 - frame.hiddenLampShare * light.a);
    vec3 around = (lamps + kMinLight + light.a * lightAround(land, s.normal)) * visibility;
    return s.albedo * (around + s.glow) + lit.albedo * frame.lightColor.rgb * (light.a * shadow);
}
