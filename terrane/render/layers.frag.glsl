// The light of all layers of blended faces over the picture: colour times coverage, and coverage.
// SAMPLES: of the layers and the G-buffer. LAYERS: 1 to 3. SHADOW: 1 where there is a shadow map. QUADS: 1 draws over the
// quads of the first layer, 0 over the whole screen.
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/render/light_sample.glsl"
#include "terrane/render/sky_color.glsl"
#include "terrane/render/surfaces.glsl"
#include "terrane/render/layer_word.glsl"
#include "terrane/render/atmosphere.glsl"
#include "terrane/render/lighting.glsl"
#include "terrane/render/water.glsl"
#if SHADOW == 1
#include "terrane/render/shadow_sample.glsl"
#endif

#if SAMPLES > 1
layout(binding = kLayerColorUnit) uniform sampler2DMS layerColors[LAYERS];
layout(binding = kLayerDepthUnit) uniform sampler2DMS layerDepths[LAYERS];
#else
layout(binding = kLayerColorUnit) uniform sampler2D layerColors[LAYERS];
layout(binding = kLayerDepthUnit) uniform sampler2D layerDepths[LAYERS];
#endif

#if QUADS == 1
vec3 inRay;
#else
layout(location = 1) in vec3 inRay;
#endif
layout(location = 0) out vec4 outColor;

const vec3 kBackground = vec3(0.35);  // of a single layer

// `behind`: depth of what comes next.
vec4 shadeLayer(Layer layer, float depth, float behind) {
    float blocks = blocksOfDepth(depth);
    vec3 toPoint = inRay * blocks, position = frame.cameraPosition.xyz + toPoint;
    if ((frame.camera.z & kSwitchUnlit) != 0) return throughAir(layer.surface.albedo, toPoint, 1.0) * layer.alpha;
    float shadow = 1.0;
#if SHADOW == 1
    shadow = lightShare(position, layer.surface.normal, length(toPoint));
#endif
    vec4 levels = levelsAt(position, layer.surface);
    vec4 color;
    if (layer.isLiquid) {
        float thickness = (min(blocksOfDepth(behind), 1e4) - blocks) * length(inRay);
        if (frame.light.w > 0.5) thickness = 0.3;  // seen from within: the water is on this side
        color = shadeWater(layer.surface, position, toPoint, thickness, levels, shadow);
    } else {
        color = vec4(shade(layer.surface, levels, shadow, 1.0) * layer.alpha, layer.alpha);
    }
    vec4 air = throughAir(color.rgb / max(color.a, 1e-3), toPoint, levels.a);
    return air * color.a;
}

// A layer that has no face there has the depth of what is opaque, and behind it there are none.
bool isThere(ivec2 pixel, int k, int n) {
    return texelFetch(layerDepths[n], pixel, k).r > depthAt(pixel, k);
}

int layersAt(ivec2 pixel, int k) {
    int count = 0;
    for (int n = 0; n < LAYERS; ++n) count += count == n && isThere(pixel, k, n) ? 1 : 0;
    return count;
}

vec4 shadeLayers(ivec2 pixel, int k) {
    vec4 sum = vec4(0.0);
    float behind = depthAt(pixel, k);
    int count = layersAt(pixel, k);
    for (int n = LAYERS - 1; n >= 0; --n) {
        if (n >= count || (frame.camera.w != 0 && frame.camera.w != n + 1)) continue;
        float depth = texelFetch(layerDepths[n], pixel, k).r;
        vec4 color = shadeLayer(unpackLayer(texelFetch(layerColors[n], pixel, k)), depth, behind);
        sum = color + (1.0 - color.a) * sum;
        behind = depth;
    }
    return sum;
}

// Whether all samples show the same.
bool isOneLayer(ivec2 pixel) {
    bool isSame = isOneSurface(pixel, surfaceAt(pixel, 0));
    int count = layersAt(pixel, 0);
    for (int k = 1; k < SAMPLES; ++k) isSame = isSame && layersAt(pixel, k) == count;
    for (int n = 0; n < LAYERS; ++n) {
        vec4 first = texelFetch(layerColors[n], pixel, 0);
        for (int k = 1; k < SAMPLES; ++k)
            isSame = isSame && (n >= count || texelFetch(layerColors[n], pixel, k) == first);
    }
    return isSame;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if QUADS == 1
    inRay = rayAt(2.0 * gl_FragCoord.xy / frame.viewport.xy - 1.0);
    outColor = shadeLayers(pixel, 0);
#else
    bool isAnyThere = false;
    for (int k = 0; k < SAMPLES; ++k) isAnyThere = isAnyThere || isThere(pixel, k, 0);
    if (!isAnyThere && frame.camera.w == 0) discard;
    int count = isOneLayer(pixel) ? 1 : SAMPLES;
    vec4 sum = vec4(0.0);
    for (int k = 0; k < count; ++k) sum += shadeLayers(pixel, k);
    outColor = sum / float(count);
    if (frame.camera.w > 0) outColor = vec4(outColor.rgb + (1.0 - outColor.a) * kBackground, 1.0);
#endif
}
