// Access to the layers of blended faces. MSAA_SAMPLES: of the layers and the G-buffer. LAYERS: their number. Needs
// gbuffer_read.glsl.
#include "terrane/render/shading/packed_layer.glsl"

#if MSAA_SAMPLES > 1
layout(binding = kTransparencyColorUnit) uniform sampler2DMS layerColors[LAYERS];
layout(binding = kTransparencyDepthUnit) uniform sampler2DMS layerDepths[LAYERS];
#else
layout(binding = kTransparencyColorUnit) uniform sampler2D layerColors[LAYERS];
layout(binding = kTransparencyDepthUnit) uniform sampler2D layerDepths[LAYERS];
#endif

// Packed surface of layer n, which may differ between pixels: a non-uniform index into textures would be undefined.
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

// A layer without a face has the depth of the opaque surface, and no layers are behind it.
bool isThere(ivec2 pixel, int k, int n) {
    return layerDepthAt(pixel, k, n) > depthAt(pixel, k);
}

int layersAt(ivec2 pixel, int k) {
    int count = 0;
    for (int n = 0; n < LAYERS; ++n) count += count == n && isThere(pixel, k, n) ? 1 : 0;
    return count;
}

// Whether all samples show the same layers.
bool isOneLayer(ivec2 pixel) {
    bool isSame = true;
    int count = layersAt(pixel, 0);
    for (int k = 1; k < MSAA_SAMPLES; ++k) isSame = isSame && layersAt(pixel, k) == count;
    for (int n = 0; n < LAYERS; ++n) {
        vec4 first = texelFetch(layerColors[n], pixel, 0);
        for (int k = 1; k < MSAA_SAMPLES; ++k)
            isSame = isSame && (n >= count || texelFetch(layerColors[n], pixel, k) == first);
    }
    return isSame;
}
