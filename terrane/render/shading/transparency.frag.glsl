// Light of all layers of blended faces over the image: the color that they add, and the share of the background that
// they transmit, for each channel.
// MSAA_SAMPLES: of the layers and the G-buffer. LAYERS: 1 to 3. SHADOW: see shared/variants.h.
// OCCLUSION: 1 with ambient occlusion of the nearest layer. LAND: see land_light.glsl. WATER_DETAIL: see water.glsl.
// QUADS: 1 draws over the quads of the first layer, 0 over the whole screen. DIRECT: 1 with QUADS writes display colors
// (target.h).
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/shading/light_sample.glsl"
#include "terrane/render/sky/sky_color.glsl"
#include "terrane/render/quads/gbuffer_read.glsl"
#include "terrane/render/shading/layer_read.glsl"
#include "terrane/render/shading/distance_fog.glsl"
#include "terrane/render/shading/lighting.glsl"
#include "terrane/render/frame/tone.glsl"

#if OCCLUSION == 1
layout(binding = kOcclusionUnit) uniform sampler2D occlusion;
#endif

#if QUADS == 1
vec3 inRay;
#else
layout(location = 1) in vec3 inRay;
#endif
#if DIRECT == 1
layout(location = 0) out vec4 outColor;
#else
layout(location = 0, index = 0) out vec4 outColor;
layout(location = 0, index = 1) out vec4 outThrough;
#endif

#include "terrane/render/water/water.glsl"
#include "terrane/render/shading/surface_shade.glsl"

const vec3 kBackground = vec3(0.35);  // of a single layer

Passed over(vec4 color) {
    return Passed(color, vec4(1.0 - color.a));
}

// `behind`: depth of the next surface. `visibility`: of ambient light. `hasFarFloor`, `isNearest`: see water.glsl.
Passed shadeLayer(Layer layer, float depth, float behind, float visibility, bool hasFarFloor, bool isNearest) {
    float blocks = blocksOfDepth(depth);
    vec3 toPoint = inRay * blocks, position = frame.cameraPosition.xyz + toPoint;
    if ((frame.switches & kSwitchUnlit) != 0)
        return over(throughAir(layer.surface.albedo, toPoint, 1.0) * layer.alpha);
    Land land = landAt(position);
    float shadow = 1.0;
#if SHADOW != SHADOW_NONE
    shadow = lightShare(position, layer.surface.normal, length(toPoint), land.share);
#endif
    vec4 levels = levelsAt(position, layer.surface);
    Passed passed;
    if (layer.isLiquid) {
        float thickness = min(blocksOfDepth(behind) - blocks, 1e4) * length(inRay);
        passed = shadeWater(layer.surface, position, toPoint, thickness, levels, shadow, visibility, hasFarFloor,
                            isNearest);
    } else {
        passed = over(vec4(shade(layer.surface, litOf(layer.surface), land, levels, shadow, visibility) * layer.alpha, layer.alpha));
    }
    // `share`: coverage of the layer; air.a: part of it that is left after fading in the distance.
    float share = max(passed.color.a, 1e-3);
    vec4 air = throughAir(passed.color.rgb / share, toPoint, levels.a);
    return Passed(air * share, 1.0 - air.a * (1.0 - passed.through));
}

// Ambient occlusion exists for the nearest layer only.
float visibilityAt(ivec2 pixel, int n) {
#if OCCLUSION == 1
    if (n == 0) return texelFetch(occlusion, pixel, 0).r;
#endif
    return 1.0;
}

// Loops over the existing layers only: software renderers run all branches.
Passed shadeLayers(ivec2 pixel, int k, float behind) {
    Passed sum = Passed(vec4(0.0), vec4(1.0));
    int last = layersAt(pixel, k) - 1;
    bool isFloorFar = packedIsFar(packedSurfaceAt(pixel, k));
    for (int n = last; n >= 0; --n) {
        float depth = layerDepthAt(pixel, k, n);
        bool isShown = frame.singleTransparencyLayer == 0 || frame.singleTransparencyLayer == n + 1;
        Layer layer = unpackLayer(packedLayerAt(pixel, k, n));
        bool hasFarFloor = isFloorFar && n == last;
        Passed one = shadeLayer(layer, depth, behind, visibilityAt(pixel, n), hasFarFloor, n == 0);
        if (!isShown) one = over(vec4(0.0));
        sum = Passed(one.color + one.through * sum.color, one.through * sum.through);
        behind = depth;
    }
    return sum;
}

// Mean depth of the opaque surfaces.
float meanDepthAt(ivec2 pixel) {
    float sum = 0.0;
    for (int k = 0; k < MSAA_SAMPLES; ++k) sum += depthAt(pixel, k);
    return sum / float(MSAA_SAMPLES);
}

// Different opaque surfaces do not require shading of each sample: a layer depends only on their distance behind it.
Passed shadeSamples(ivec2 pixel) {
    bool isOne = isOneLayer(pixel);
    int count = isOne ? 1 : MSAA_SAMPLES;
    float meanBehind = meanDepthAt(pixel);
    Passed sum = Passed(vec4(0.0), vec4(0.0));
    for (int k = 0; k < count; ++k) {
        Passed one = shadeLayers(pixel, k, isOne ? meanBehind : depthAt(pixel, k));
        sum = Passed(sum.color + one.color, sum.through + one.through);
    }
    Passed mean = Passed(sum.color / float(count), sum.through / float(count));
    if (frame.singleTransparencyLayer > 0)
        mean = Passed(vec4(mean.color.rgb + mean.through.rgb * kBackground, 1.0), vec4(0.0));
    return mean;
}

#if DIRECT == 1
vec3 skyBehind(vec3 direction) {
    vec3 color = skyColor(direction);
#if UNDER_WATER == 1
    color = throughWindow(color, direction);
#endif
    return color;
}

// Color of the opaque surface or the sky, as in the image but before tone mapping.
vec3 colorBehind(ivec2 pixel) {
    float depth = depthAt(pixel, 0);
    if (depth <= 0.0) return skyBehind(normalize(inRay));
    Surface s = unpackSurface(packedSurfaceAt(pixel, 0));
    return shadeAt(s, litOf(s), depth, 1.0).rgb;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if QUADS == 1
    inRay = rayAt(2.0 * gl_FragCoord.xy / frame.viewportSize - 1.0);
    Passed passed = shadeLayers(pixel, 0, depthAt(pixel, 0));
#else
    Passed passed = shadeSamples(pixel);
#endif
#if DIRECT == 1
    outColor = vec4(screenColor(passed.color.rgb + passed.through.rgb * colorBehind(pixel), pixel), 1.0);
#else
    outColor = passed.color;
    outThrough = passed.through;
#endif
}
