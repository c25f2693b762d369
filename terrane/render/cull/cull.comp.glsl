// Finds the face directions of each mesh section that the camera may see.
#include "terrane/shared/bindings.h"
#include "terrane/shared/culling.h"

layout(local_size_x = kCullThreads) in;

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

// Whether the depth drawn so far hides the box, waves included: it lies behind the farthest depth of all pixels that it
// covers.
bool isHidden(vec3 low, vec3 high) {
    Footprint print = footprintOfBox(cull.view, low, high);
    if (print.isBefore == 0u) return false;
    HiZArea area = hiZAreaOfBox(cull.view, print);
    float farthest = 1.0;
    for (int y = area.first.y; y <= area.last.y; ++y) {
        for (int x = area.first.x; x <= area.last.x; ++x)
            farthest = min(farthest, texelFetch(hiZ, ivec2(x, y), area.level).r);
    }
    return print.nearest < farthest;
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
    uint directions = isInView ? facingDirections(cull.cameraPosition.xyz, low, high) : 0u;
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
