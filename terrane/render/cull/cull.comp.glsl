// Finds the face directions of each mesh section that the camera may see.
#include "terrane/shared/bindings.h"
#include "terrane/shared/mesh_section.h"

layout(local_size_x = kCullThreads) in;

const int kMaxHiZTexels = 64;  // read for a box

layout(binding = kHiZUnit) uniform sampler2D hiZ;  // the farthest depths of squares of pixels

layout(std140, binding = kCullBinding) uniform CullBlock {
    CullFrame cull;
};
layout(std430, binding = kMeshSectionsBinding) readonly buffer MeshSections {
    MeshSectionRecord meshSections[];
};
layout(std430, binding = kMeshSectionOrderBinding) readonly buffer Order {
    uint order[];
};
layout(std430, binding = kVisibleLastFrameBinding) buffer VisibleLastFrame {
    uint visibleLastFrame[];  // by slot: directions in which the mesh section has quads that were not hidden
};
layout(std430, binding = kVisibleBinding) writeonly buffer Visible {
    uint visible[];  // in the order of mesh sections
};
layout(std430, binding = kTestedMeshSectionsBinding) buffer Tested {
    TestedMeshSections tested;
    uint testedNumbers[];
};

bool isOutside(vec4 plane, vec3 low, vec3 high) {
    vec3 farthest = mix(low, high, greaterThan(plane.xyz, vec3(0.0)));
    return dot(plane.xyz, farthest) + plane.w < 0.0;
}

// Whether the depth drawn so far hides the box, waves included: it lies behind the farthest depth of all pixels that it
// covers.
bool isHidden(vec3 low, vec3 high) {
    vec2 screenMin = vec2(1.0), screenMax = vec2(-1.0);
    float nearest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        vec3 at = mix(low, high, vec3(corner & 1, corner >> 1 & 1, corner >> 2));
        vec4 clip = cull.viewProjection * vec4(at, 1.0);
        if (clip.w <= 2.0 * cull.nearPlane) return false;
        vec2 screen = clip.xy / clip.w;
        screenMin = min(screenMin, screen);
        screenMax = max(screenMax, screen);
        nearest = max(nearest, cull.nearPlane / clip.w);
    }
    // One more pixel on each side, since quads grow a little.
    vec2 from = clamp((0.5 + 0.5 * screenMin) * cull.viewportSize - 1.0, vec2(0.0), cull.viewportSize - 1.0);
    vec2 to = clamp((0.5 + 0.5 * screenMax) * cull.viewportSize + 1.0, vec2(0.0), cull.viewportSize - 1.0);
    // The finest level at which few texels cover the box: far land is wide and flat.
    ivec2 first = ivec2(from) / int(kHiZTexelPixels), last = ivec2(to) / int(kHiZTexelPixels), size = last - first + 1;
    int level = 0;
    while (size.x * size.y > kMaxHiZTexels && level + 1 < cull.hiZLevels) {
        ++level;
        size = (last >> level) - (first >> level) + 1;
    }
    first >>= level;
    last >>= level;
    float farthest = 1.0;
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) farthest = min(farthest, texelFetch(hiZ, ivec2(x, y), level).r);
    }
    return nearest < farthest;
}

// The last direction is that of oblique and two-sided faces.
uint bitsOf(bvec3 negative, bvec3 positive) {
    return uint(negative.x) | uint(positive.x) << 1 | uint(negative.y) << 2 | uint(positive.y) << 3 |
           uint(negative.z) << 4 | uint(positive.z) << 5 | 1u << 6;
}

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= cull.meshSectionCount) return;
    uint slot = order[number];
    uint heights = meshSections[slot].heights;
    uint level = placeLevel(meshSections[slot].place);
    vec2 corner = chunkCorner(meshSections[slot].chunk, level, cull.cameraChunk);
    float width = float(kChunkSize) * columnBlocks(level);
    vec3 low = vec3(corner, float(lowHeight(heights))), high = vec3(corner + width, float(highHeight(heights)));

    bool isInView = true;
    vec3 wavingLow = low - kWaving, wavingHigh = high + kWaving;
    for (int k = 0; k < 5; ++k) {
        if (isOutside(cull.cameraPlanes[k], wavingLow, wavingHigh)) isInView = false;
    }
    // All faces toward -x are seen from behind if the camera is beyond the last of them, and so on.
    vec3 camera = cull.cameraPosition.xyz;
    uint directions = isInView ? bitsOf(lessThan(camera, high), greaterThan(camera, low)) : 0u;
    uint word = (meshSections[slot].ranges[0].x / cull.arenaQuads) << kArenaBits;
    if (cull.phase == kCullAll) {
        word |= directions << kOpaqueDirectionBits | directions << kBlendedDirectionBits;
    } else if (cull.phase == kCullEarly) {
        word |= (directions & visibleLastFrame[slot]) << kOpaqueDirectionBits;
    } else {
        uint drawnEarly = directions & visibleLastFrame[slot];
        visibleLastFrame[slot] = 0u;
        if (directions != 0u && !isHidden(wavingLow, wavingHigh)) {
            // The test of its quads adds the directions of visible quads.
            word |= directions << kBlendedDirectionBits | drawnEarly << kDrawnEarlyBits;
            uint place = atomicAdd(tested.count, 1u);
            testedNumbers[place] = number;
            if (place < cull.maxTestGroups) atomicAdd(tested.groups, 1u);
        }
    }
    visible[number] = word;
}
