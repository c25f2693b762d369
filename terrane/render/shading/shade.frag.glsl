// Shades the G-buffer: light toward the camera as premultiplied color and coverage, over the sky.
// MSAA_SAMPLES: of the G-buffer. PER_SAMPLE: 1 shades each sample of a pixel with several surfaces, 0 their mean.
// SHADOW: see shared/variants.h. OCCLUSION: 1 with ambient occlusion. LAND, FAR: see
// land_light.glsl, lighting.glsl. OVER_SKY: 1 blends fading surfaces with the sky that was drawn behind them, 0
// computes the sky here: without clouds its color is known, and no sky needs to be drawn or read. DIRECT: 1 writes
// display colors (target.h).
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/shading/light_sample.glsl"
#include "terrane/render/sky/sky_color.glsl"
#include "terrane/render/quads/gbuffer_read.glsl"
#include "terrane/render/shading/distance_fog.glsl"
#include "terrane/render/shading/lighting.glsl"
#include "terrane/render/frame/tone.glsl"
#if OCCLUSION == 1
layout(binding = kOcclusionUnit) uniform sampler2D occlusion;
#endif

layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outColor;

#include "terrane/render/shading/surface_shade.glsl"

#if MSAA_SAMPLES > 1 && PER_SAMPLE == 1
const float kSameDepth = 1.0 / 64.0;  // of the distance: surfaces this close share shadow, light and air

// Neighboring faces at an edge are one surface with their mean color, normal and light: the incoming light is linear in
// them. Then most pixels have one surface, and others two.
struct Samples {
    Surface mean;  // direction: of the first
    Lit lit;       // normal: of a face that looks to the light
    float depth;   // of the first
    int count;
};

bool isLike(Surface s, float depth, Samples group) {
    return s.direction != kDirectionNone && s.isFar == group.mean.isFar &&
        abs(depth - group.depth) <= kSameDepth * group.depth;
}

Samples samplesLike(ivec2 pixel, int first, inout int left) {
    Surface own = unpackSurface(packedSurfaceAt(pixel, first));
    Samples group = Samples(own, litOf(own), depthAt(pixel, first), 1);
    left &= ~(1 << first);
    for (int k = 1; k < MSAA_SAMPLES; ++k) {
        Surface s = unpackSurface(packedSurfaceAt(pixel, k));
        if ((left & 1 << k) == 0 || !isLike(s, depthAt(pixel, k), group)) continue;
        Lit lit = litOf(s);
        group.lit.normal = lit.albedo.g > 0.0 && group.lit.albedo.g == 0.0 ? lit.normal : group.lit.normal;
        group.lit.albedo += lit.albedo;
        group.mean.albedo += s.albedo;
        group.mean.normal += s.normal;
        group.mean.glow += s.glow;
        ++group.count;
        left &= ~(1 << k);
    }
    float share = 1.0 / float(group.count);
    group.lit.albedo *= share;
    group.mean.albedo *= share;
    group.mean.normal *= share;
    group.mean.glow *= share;
    return group;
}

vec4 shadePixel(ivec2 pixel, float visibility) {
    vec4 sum = vec4(0.0);
    int left = 0;
    for (int k = 0; k < MSAA_SAMPLES; ++k)
        left |= packedDirection(packedSurfaceAt(pixel, k)) != kDirectionNone ? 1 << k : 0;
    do {
        Samples group = samplesLike(pixel, findLSB(left), left);
        sum += shadeAt(group.mean, group.lit, group.depth, visibility) * float(group.count);
    } while (left != 0);
    return sum / float(MSAA_SAMPLES);
}
#elif MSAA_SAMPLES > 1
vec4 shadePixel(ivec2 pixel, float visibility) {
    Surface mean = Surface(vec3(0.0), vec3(0.0), 0.0, kDirectionNone, false, false);
    float nearest = 0.0;
    int covered = 0;
    for (int k = 0; k < MSAA_SAMPLES; ++k) {
        vec4 packedSurface = packedSurfaceAt(pixel, k);
        if (packedDirection(packedSurface) == kDirectionNone) continue;
        Surface s = unpackSurface(packedSurface);
        float depth = depthAt(pixel, k);
        mean.albedo += s.albedo;
        mean.normal += s.normal;
        mean.glow += s.glow;
        if (depth > nearest) {
            mean.direction = s.direction;
            mean.isFar = s.isFar;
            mean.isFigure = s.isFigure;
        }
        nearest = max(nearest, depth);
        ++covered;
    }
    float share = 1.0 / float(covered);
    mean.albedo *= share;
    mean.normal = normalize(mean.normal + 1e-4);
    mean.glow *= share;
    return shadeAt(mean, litOf(mean), nearest, visibility) * float(covered) / float(MSAA_SAMPLES);
}
#else
// The depth test has left out the sky.
vec4 shadePixel(ivec2 pixel, float visibility) {
    Surface s = unpackSurface(packedSurfaceAt(pixel, 0));
    return shadeAt(s, litOf(s), depthAt(pixel, 0), visibility);
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float visibility = 1.0;
#if OCCLUSION == 1
    visibility = texelFetch(occlusion, pixel, 0).r;
#endif
    outColor = shadePixel(pixel, visibility);
#if DIRECT == 1
    outColor = vec4(screenColor(outColor.rgb, pixel), 1.0);
#endif
}
