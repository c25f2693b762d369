// From the G-buffer to the light that reaches the camera: color times coverage, and coverage, over the sky.
// MSAA_SAMPLES: of the G-buffer. PER_SAMPLE: 1 shades each sample of a pixel with several surfaces, 0 their mean.
// SHADOW: 0 without shadows, else see shadow_sample.glsl. OCCLUSION: 1 where there is ambient occlusion. LAND, FAR:
// see land_light.glsl, lighting.glsl. OVER_SKY: 1 blends what fades with the sky that was drawn behind it, 0 does so here: without
// clouds the sky's color is known, and nothing behind need be drawn or read. DIRECT: 1 writes what the screen shows (direct_image.h).
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/render/light_sample.glsl"
#include "terrane/render/sky_color.glsl"
#include "terrane/render/gbuffer_read.glsl"
#include "terrane/render/distance_fog.glsl"
#include "terrane/render/lighting.glsl"
#include "terrane/render/tone.glsl"
#if OCCLUSION == 1
layout(binding = kOcclusionUnit) uniform sampler2D occlusion;
#endif

layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outColor;

#include "terrane/render/surface_shade.glsl"

#if MSAA_SAMPLES > 1 && PER_SAMPLE == 1
// Each surface once, with the share of its samples: at most edges there are two.
vec4 shadePixel(ivec2 pixel, float visibility) {
    vec4 sum = vec4(0.0);
    int left = (1 << MSAA_SAMPLES) - 1;
    do {
        int first = findLSB(left);
        vec4 packedSurface = packedSurfaceAt(pixel, first);
        int same = samplesOf(pixel, packedSurface);
        vec4 color = shadeAt(unpackSurface(packedSurface), depthAt(pixel, first), visibility);
        if (packedDirection(packedSurface) != kDirectionNone) sum += color * float(bitCount(same));
        left &= ~same;
    } while (left != 0);
    return sum / float(MSAA_SAMPLES);
}
#elif MSAA_SAMPLES > 1
vec4 shadePixel(ivec2 pixel, float visibility) {
    Surface mean = Surface(vec3(0.0), vec3(0.0), 0.0, kDirectionNone, false);
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
        }
        nearest = max(nearest, depth);
        ++covered;
    }
    float share = 1.0 / float(covered);
    mean.albedo *= share;
    mean.normal = normalize(mean.normal + 1e-4);
    mean.glow *= share;
    return shadeAt(mean, nearest, visibility) * float(covered) / float(MSAA_SAMPLES);
}
#else
// The depth test has left out the sky.
vec4 shadePixel(ivec2 pixel, float visibility) {
    return shadeAt(unpackSurface(packedSurfaceAt(pixel, 0)), depthAt(pixel, 0), visibility);
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
