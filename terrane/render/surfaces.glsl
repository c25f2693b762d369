// The G-buffer as shaders read it. SAMPLES: a pixel's samples; with more than one the textures are multisampled.
#include "terrane/render/surface_word.glsl"

#if SAMPLES > 1
layout(binding = kSurfaceUnit) uniform sampler2DMS surfaces;
layout(binding = kDepthUnit) uniform sampler2DMS depths;
#else
layout(binding = kSurfaceUnit) uniform sampler2D surfaces;
layout(binding = kDepthUnit) uniform sampler2D depths;
#endif

vec4 surfaceAt(ivec2 pixel, int k) {
    return texelFetch(surfaces, pixel, k);
}
float depthAt(ivec2 pixel, int k) {
    return texelFetch(depths, pixel, k).r;
}

// Of a point from the camera, along the view; 0 is the sky's depth.
float blocksOfDepth(float depth) {
    return frame.nearPlane / max(depth, 1e-9);
}

// Equal words are one surface: its texture is read once a pixel. Bits of its samples.
int samplesOf(ivec2 pixel, vec4 word) {
    int samples = 0;
    for (int k = 0; k < SAMPLES; ++k) samples |= surfaceAt(pixel, k) == word ? 1 << k : 0;
    return samples;
}

bool isOneSurface(ivec2 pixel, vec4 first) {
    bool isSame = true;
    for (int k = 1; k < SAMPLES; ++k) isSame = isSame && surfaceAt(pixel, k) == first;
    return isSame;
}
