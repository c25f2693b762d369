// Which groups of faces of each region the camera may see, and which of them may throw a shadow.
#include "terrane/shared/bindings.h"
#include "terrane/shared/region.h"

layout(local_size_x = 64) in;

layout(std140, binding = kCullBinding) uniform CullBlock {
    CullFrame cull;
};
layout(std430, binding = kRegionsBinding) readonly buffer Regions {
    RegionRecord regions[];
};
layout(std430, binding = kRegionOrderBinding) readonly buffer Order {
    uint order[];
};
layout(std430, binding = kVisibleBinding) writeonly buffer Visible {
    uint visible[];  // in the order of regions
};

bool isOutside(vec4 plane, vec3 low, vec3 high) {
    vec3 farthest = mix(low, high, greaterThan(plane.xyz, vec3(0.0)));
    return dot(plane.xyz, farthest) + plane.w < 0.0;
}

// The last group is that of faces which may look anywhere.
uint bitsOf(bvec3 negative, bvec3 positive) {
    return uint(negative.x) | uint(positive.x) << 1 | uint(negative.y) << 2 | uint(positive.y) << 3 |
           uint(negative.z) << 4 | uint(positive.z) << 5 | 1u << 6;
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= uint(cull.camera.z)) return;
    uint slot = order[number];
    uint heights = regions[slot].heights;
    vec2 corner = 16.0 * vec2(regions[slot].chunk - cull.camera.xy);
    vec3 low = vec3(corner, float(heights & 0xFFFFu)), high = vec3(corner + 16.0, float(heights >> 16));

    bool isSeen = true, isCasting = cull.lightDirection.w > 0.0;
    for (int k = 0; k < 5; ++k) {
        if (isOutside(cull.cameraPlanes[k], low, high)) isSeen = false;
        if (isOutside(cull.shadowPlanes[k], low, high)) isCasting = false;
    }
    // Every face that looks to -x is seen from behind where the camera is beyond the last of them, and so on.
    uint word = 0u;
    vec3 camera = cull.cameraPosition.xyz, light = cull.lightDirection.xyz;
    if (isSeen) word = bitsOf(lessThan(camera, high), greaterThan(camera, low)) << kCameraGroupBits;
    if (isCasting) word |= bitsOf(lessThan(light, vec3(0.0)), greaterThan(light, vec3(0.0))) << kShadowGroupBits;
    visible[number] = word;
}
