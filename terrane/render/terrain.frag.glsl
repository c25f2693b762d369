// ALPHA_CLASS: 0 opaque, 1 tested, 2 blended.
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/render/light_sample.glsl"
#include "terrane/render/sky_color.glsl"
#include "terrane/shared/material.h"

layout(binding = kBlockTexturesUnit) uniform sampler2DArray blockTextures;

layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec2 inTexel;
layout(location = 2) flat in vec3 inNormal;
layout(location = 3) flat in uvec4 inMaterial;
layout(location = 4) flat in uint inIsOblique;
layout(location = 5) flat in vec2 inExtent;
layout(location = 0) out vec4 outColor;

// Magnified textures are constant inside a texel and blend linearly over one pixel at its edges: neither blocks that
// shimmer nor blur. They repeat inside a quad, but filters must not reach around its edge to the opposite one, where
// a plant has its stem and a grass block its soil: half a texel of the mipmap stays between.
vec4 sampleTexture() {
    vec2 size = vec2(textureSize(blockTextures, 0).xy);
    vec2 texel = inTexel * size;
    vec2 width = max(fwidth(texel), 1e-6);
    vec2 edge = floor(texel + 0.5);
    vec2 sharp = edge + clamp((texel - edge) / width, -0.5, 0.5);
    float largest = max(width.x, width.y);
    vec2 at = largest < 1.0 ? sharp : texel;
    vec2 margin = min(vec2(0.5 * max(largest, 1.0)), 0.5 * size);
    at = clamp(at, margin, inExtent * size - margin);
    return textureGrad(blockTextures, vec3(at / size, inMaterial.x), dFdx(inTexel), dFdy(inTexel));
}

const vec3 kLeastLight = vec3(0.02);  // of the darkest cave: shapes can just be seen

// Lamps, hidden by day where daylight reaches; the sky from above; the sun or moon where the sky is seen.
vec3 shade(vec3 albedo, vec3 normal, vec4 levels, float glow) {
    vec4 light = pow(levels, vec4(0.85));
    float up = 0.5 + 0.5 * normal.z;
    vec3 sky = frame.ambientColor.rgb * mix(frame.ambientColor.w, 1.0, up);
    float facing = max(dot(normal, frame.lightDirection.xyz), 0.0);
    vec3 lamps = (light.rgb + glow) * (1.0 - frame.glowColor.w * light.a);
    return albedo * (lamps + kLeastLight + light.a * (sky + frame.lightColor.rgb * facing));
}

vec3 fade(vec3 color, vec3 toPoint) {
    float share = length(toPoint.xy) / frame.cameraPosition.w;
    float haze = 1.0 - exp(-0.9 * share * share * share);
    float amount = max(haze, smoothstep(0.8, 1.0, share));
    vec3 direction = normalize(toPoint);
    direction.z = max(direction.z, 0.0);
    return mix(color, skyColor(direction), amount);
}

// Water mirrors the sky at flat angles (Schlick's approximation, reflectance 0.02 straight down).
vec4 waterColor(vec4 texel, vec3 lit, vec3 normal, vec3 view) {
    float facing = clamp(abs(dot(view, normal)), 0.0, 1.0);
    float mirrored = 0.02 + 0.98 * pow(1.0 - facing, 5.0);
    vec3 reflected = reflect(view, normal);
    reflected.z = abs(reflected.z);
    return vec4(mix(lit, skyColor(normalize(reflected)), mirrored), mix(texel.a, 1.0, mirrored));
}

vec4 debugView(uint view, vec3 normal, vec3 toPoint) {
    if (view == kViewNormal) return vec4(0.5 + 0.5 * normal, 1.0);
    return vec4(vec3(1.0 - clamp(length(toPoint) / frame.cameraPosition.w, 0.0, 1.0)), 1.0);
}

// The texture stays visible and sides differ, so that one sees where one is.
vec3 aggregationView(vec3 albedo, vec3 normal) {
    vec3 color = 0.25 + 0.75 * vec3(inMaterial.w & 255u, inMaterial.w >> 8 & 255u, inMaterial.w >> 16 & 255u) / 255.0;
    float texture = sqrt(dot(albedo, vec3(0.3, 0.6, 0.1)));
    float side = 0.75 + dot(normal, vec3(0.05, 0.1, 0.25));
    return color * side * (0.5 + 0.6 * texture);
}

void main() {
    vec4 texel = sampleTexture();
#if ALPHA_CLASS == 1
    if (texel.a < (inMaterial.y == kAlphaTestGlow ? 0.25 : 0.5)) discard;
#endif
    vec3 normal = gl_FrontFacing ? inNormal : -inNormal;
    vec3 toPoint = inPosition - frame.cameraPosition.xyz;
    uint view = uint(frame.horizonColor.w);
    if (view == kViewAggregation) {
        outColor = vec4(aggregationView(texel.rgb, normal), 1.0);
        return;
    }
    if (view != kViewColor) {
        outColor = debugView(view, normal, toPoint);
        return;
    }
    // Crossed planes are lit like the ground they stand on: their own normals would split each plant in two.
    vec3 shadingNormal = inIsOblique == 1u ? vec3(0.0, 0.0, 1.0) : normal;
    float glow = 0.0;
    if (inMaterial.y == kAlphaGlow) glow = texel.a;
    if (inMaterial.y == kAlphaTestGlow) glow = clamp(2.0 * texel.a - 1.0, 0.0, 1.0);
    // Plants stand inside their block and take its light.
    vec3 lightNormal = inIsOblique == 1u ? vec3(0.0) : normal;
    vec3 color = shade(texel.rgb, shadingNormal, sampleLight(inPosition, lightNormal), glow);
    color += texel.rgb * glow * frame.glowColor.w;
#if ALPHA_CLASS == 2
    vec4 blended = vec4(color, texel.a);
    if (inMaterial.z == kAnimationLiquidSurface) blended = waterColor(texel, color, normal, normalize(toPoint));
    outColor = vec4(fade(blended.rgb, toPoint), blended.a);
#else
    outColor = vec4(fade(color, toPoint), 1.0);
#endif
}
