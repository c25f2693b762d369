// A mip level of Hi-Z: the farthest depth of each square of pixels, which is the smallest. Pixels beyond the image
// count as near. LEVEL_0: 1 makes the finest level from the depth, 0 another one from the level before. MSAA_SAMPLES:
// of the depth.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/shared/mesh_section.h"

layout(local_size_x = kHiZThreads, local_size_y = kHiZThreads) in;

layout(binding = kHiZToImage, r32f) writeonly uniform image2D to;

#if LEVEL_0 == 1
#if MSAA_SAMPLES > 1
layout(binding = kDepthUnit) uniform sampler2DMS depths;
#else
layout(binding = kDepthUnit) uniform sampler2D depths;
#endif

float farthestIn(ivec2 texel) {
    ivec2 first = texel * int(kHiZTexelPixels), end = min(first + int(kHiZTexelPixels), ivec2(frame.viewportSize));
    float farthest = 1.0;
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) {
            for (int k = 0; k < MSAA_SAMPLES; ++k) farthest = min(farthest, texelFetch(depths, ivec2(x, y), k).r);
        }
    }
    return farthest;
}
#else
layout(binding = kHiZFromImage, r32f) readonly uniform image2D from;

float farthestIn(ivec2 texel) {
    float farthest = 1.0;
    ivec2 last = imageSize(from) - 1;  // if a level has one row, so has the next
    for (int k = 0; k < 4; ++k) {
        farthest = min(farthest, imageLoad(from, min(2 * texel + ivec2(k & 1, k >> 1), last)).r);
    }
    return farthest;
}
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size = imageSize(to);
    if (texel.x < size.x && texel.y < size.y) imageStore(to, texel, vec4(farthestIn(texel)));
}
