// Access to the G-buffer. MSAA_SAMPLES: a pixel's samples; with more than one the textures are multisampled.
#include "terrane/render/quads/packed_gbuffer.glsl"

#if MSAA_SAMPLES > 1
layout(binding = kGBufferUnit) uniform sampler2DMS surfaces;
layout(binding = kDepthUnit) uniform sampler2DMS depths;
#else
layout(binding = kGBufferUnit) uniform sampler2D surfaces;
layout(binding = kDepthUnit) uniform sampler2D depths;
#endif

vec4 packedSurfaceAt(ivec2 pixel, int k) {
    return texelFetch(surfaces, pixel, k);
}
float depthAt(ivec2 pixel, int k) {
    return texelFetch(depths, pixel, k).r;
}

// Distance of a depth from the camera along the view direction, blocks; 0 is the sky's depth.
float blocksOfDepth(float depth) {
    return frame.nearPlane / max(depth, 1e-9);
}
