// The light of all layers of blended faces over the image: color times coverage, and coverage.
// MSAA_SAMPLES: of the layers and the G-buffer. LAYERS: 1 to 3. SHADOW: 0 without shadows, else see shadow_sample.glsl.
// OCCLUSION: 1 where there is ambient occlusion of the nearest layer. LAND: see land_light.glsl. QUADS: 1 draws over the
// quads of the first layer, 0 over the whole screen. DIRECT: 1 with QUADS writes what the screen shows (direct_image.h).
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/render/light_sample.glsl"
#include "terrane/render/sky_color.glsl"
#include "terrane/render/gbuffer_read.glsl"
#include "terrane/render/packed_layer.glsl"
#include "terrane/render/distance_fog.glsl"
#include "terrane/render/land_light.glsl"
#include "terrane/render/lighting.glsl"
#include "terrane/render/water.glsl"
#include "terrane/render/tone.glsl"

#if MSAA_SAMPLES > 1
layout(binding = kTransparencyColorUnit) uniform sampler2DMS layerColors[LAYERS];
layout(binding = kTransparencyDepthUnit) uniform sampler2DMS layerDepths[LAYERS];
#else
layout(binding = kTransparencyColorUnit) uniform sampler2D layerColors[LAYERS];
layout(binding = kTransparencyDepthUnit) uniform sampler2D layerDepths[LAYERS];
#endif
#if OCCLUSION == 1
layout(binding = kOcclusionUnit) uniform sampler2D occlusion;
#endif

#if QUADS == 1
vec3 inRay;
#else
layout(location = 1) in vec3 inRay;
#endif
layout(location = 0) out vec4 outColor;

#include "terrane/render/surface_shade.glsl"

const vec3 kBackground = vec3(0.35);  // of a single layer

// `behind`: depth of what comes next. `visibility`: of light from all around. `hasFarFloor`: see water.glsl.
vec4 shadeLayer(Layer layer, float depth, float behind, float visibility, bool hasFarFloor) {
    float blocks = blocksOfDepth(depth);
    vec3 toPoint = inRay * blocks, position = frame.cameraPosition.xyz + toPoint;
    if ((frame.switches & kSwitchUnlit) != 0) return throughAir(layer.surface.albedo, toPoint, 1.0) * layer.alpha;
    float shadow = 1.0;
#if SHADOW > 0
    shadow = lightShare(position, layer.surface.normal, length(toPoint));
#endif
    vec4 levels = levelsAt(position, layer.surface);
    vec4 color;
    if (layer.isLiquid) {
        float thickness = min(blocksOfDepth(behind) - blocks, 1e4) * length(inRay);
        if (frame.isUnderWater != 0u) thickness = 0.3;  // seen from within: the water is on this side
        color = shadeWater(layer.surface, position, toPoint, thickness, levels, shadow, visibility, hasFarFloor);
    } else {
        color = vec4(shade(layer.surface, position, levels, shadow, visibility) * layer.alpha, layer.alpha);
    }
    vec4 air = throughAir(color.rgb / max(color.a, 1e-3), toPoint, levels.a);
    return air * color.a;
}

// Of one of the layers. Which one may differ from pixel to pixel: such an index of textures would be undefined.
vec4 packedLayerAt(ivec2 pixel, int k, int n) {
    vec4 packedLayer = texelFetch(layerColors[0], pixel, k);
    for (int m = 1; m < LAYERS; ++m) packedLayer = m == n ? texelFetch(layerColors[m], pixel, k) : packedLayer;
    return packedLayer;
}

float layerDepthAt(ivec2 pixel, int k, int n) {
    float depth = texelFetch(layerDepths[0], pixel, k).r;
    for (int m = 1; m < LAYERS; ++m) depth = m == n ? texelFetch(layerDepths[m], pixel, k).r : depth;
    return depth;
}

// A layer that has no face there has the depth of what is opaque, and behind it there are none.
bool isThere(ivec2 pixel, int k, int n) {
    return layerDepthAt(pixel, k, n) > depthAt(pixel, k);
}

int layersAt(ivec2 pixel, int k) {
    int count = 0;
    for (int n = 0; n < LAYERS; ++n) count += count == n && isThere(pixel, k, n) ? 1 : 0;
    return count;
}

// Found for the nearest layer alone.
float visibilityAt(ivec2 pixel, int n) {
#if OCCLUSION == 1
    if (n == 0) return texelFetch(occlusion, pixel, 0).r;
#endif
    return 1.0;
}

// A loop over the layers that are there: software renderers run what a branch leaves out.
vec4 shadeLayers(ivec2 pixel, int k) {
    vec4 sum = vec4(0.0);
    float behind = depthAt(pixel, k);
    int last = layersAt(pixel, k) - 1;
    bool isFloorFar = packedIsFar(packedSurfaceAt(pixel, k));
    for (int n = last; n >= 0; --n) {
        float depth = layerDepthAt(pixel, k, n);
        bool isShown = frame.singleTransparencyLayer == 0 || frame.singleTransparencyLayer == n + 1;
        Layer layer = unpackLayer(packedLayerAt(pixel, k, n));
        bool hasFarFloor = isFloorFar && n == last;
        vec4 color = isShown ? shadeLayer(layer, depth, behind, visibilityAt(pixel, n), hasFarFloor) : vec4(0.0);
        sum = color + (1.0 - color.a) * sum;
        behind = depth;
    }
    return sum;
}

// Whether all samples show the same.
bool isOneLayer(ivec2 pixel) {
    bool isSame = isOneSurface(pixel, packedSurfaceAt(pixel, 0));
    int count = layersAt(pixel, 0);
    for (int k = 1; k < MSAA_SAMPLES; ++k) isSame = isSame && layersAt(pixel, k) == count;
    for (int n = 0; n < LAYERS; ++n) {
        vec4 first = texelFetch(layerColors[n], pixel, 0);
        for (int k = 1; k < MSAA_SAMPLES; ++k)
            isSame = isSame && (n >= count || texelFetch(layerColors[n], pixel, k) == first);
    }
    return isSame;
}

vec4 shadeSamples(ivec2 pixel) {
    int count = isOneLayer(pixel) ? 1 : MSAA_SAMPLES;
    vec4 sum = vec4(0.0);
    for (int k = 0; k < count; ++k) sum += shadeLayers(pixel, k);
    vec4 color = sum / float(count);
    return frame.singleTransparencyLayer > 0 ? vec4(color.rgb + (1.0 - color.a) * kBackground, 1.0) : color;
}

#if DIRECT == 1
// What is opaque, or the sky, as it is in the image already but for the curve.
vec3 colorBehind(ivec2 pixel) {
    float depth = depthAt(pixel, 0);
    if (depth <= 0.0) return skyColor(normalize(inRay));
    return shadeAt(unpackSurface(packedSurfaceAt(pixel, 0)), depth, 1.0).rgb;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if QUADS == 1
    inRay = rayAt(2.0 * gl_FragCoord.xy / frame.viewportSize - 1.0);
    outColor = shadeLayers(pixel, 0);
#if DIRECT == 1
    outColor = vec4(screenColor(outColor.rgb + (1.0 - outColor.a) * colorBehind(pixel), pixel), 1.0);
#endif
#else
    outColor = shadeSamples(pixel);
#endif
}
