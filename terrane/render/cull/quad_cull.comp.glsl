// Tests the quads of mesh sections for visibility against Hi-Z: a work group for a mesh section (or for several, if
// there are more than work groups), a thread for a quad.
// Writes two bits of each quad (cull_pass.h), and the directions of the mesh section that have quads with them.
#include "terrane/shared/bindings.h"
#include "terrane/shared/culling.h"
#include "terrane/shared/frame.h"
#include "terrane/shared/material.h"

layout(local_size_x = kQuadCullThreads) in;

layout(location = kArenaLocation) uniform uint arena;
layout(binding = kHiZUnit) uniform sampler2D hiZ;
layout(binding = kShapeFacesUnit) uniform samplerBuffer shapeFaces;
layout(binding = kMaterialsUnit) uniform usamplerBuffer materials;

layout(std140, binding = kCullBinding) uniform CullBlock {
    CullFrame cull;
};
layout(std430, binding = kMeshSectionsBinding) readonly buffer MeshSections {
    MeshSectionRecord meshSections[];
};
layout(std430, binding = kMeshSectionOrderBinding) readonly buffer Order {
    uint order[];
};
layout(std430, binding = kVisibleBinding) buffer Visible {
    uint visible[];
};
layout(std430, binding = kTestedMeshSectionsBinding) readonly buffer Tested {
    TestedMeshSections tested;
    uint testedNumbers[];
};
layout(std430, binding = kVisibleLastFrameBinding) buffer VisibleLastFrame {
    uint visibleLastFrame[];  // by slot: directions
};
layout(std430, binding = kQuadsBinding) buffer Quads {
    Quad quads[];
};

const uint kTestedRanges = 2u * kRangesOfTwoBuckets;  // of opaque and tested faces

ShapeFace shapeOf(Quad quad) {
    uint number = quadShapeFace(quad);
    int face = 4 * int(number);
    ShapeFace shape = ShapeFace(texelFetch(shapeFaces, face), texelFetch(shapeFaces, face + 1),
                                texelFetch(shapeFaces, face + 2), flatBend());
    if (number >= kShapeFaceCount) shape.bend = texelFetch(shapeFaces, face + 3);
    return shape;
}

// Whether a quad can be seen now, and whether it may be soon.
bvec2 isVisible(Quad quad, bool isTwoSided, vec3 slabCorner, float columnWidth) {
    bool isWaving = lookAnimation(texelFetch(materials, int(quadMaterial(quad))).r) != kAnimationNone;
    Footprint print = footprintOfQuad(cull.view, quad, shapeOf(quad), isWaving, isTwoSided, slabCorner, columnWidth);
    if (print.isBefore == 0u) return bvec2(true);
    HiZArea area = hiZAreaOfQuad(cull.view, print);
    float farthest = 1.0;
    for (int y = area.first.y; y <= area.last.y; ++y) {
        for (int x = area.first.x; x <= area.last.x; ++x)
            farthest = min(farthest, texelFetch(hiZ, ivec2(x, y), area.level).r);
    }
    return bvec2(isQuadVisible(cull.view, print, farthest), isQuadVisibleSoon(cull.view, print, farthest));
}

void testMeshSection(uint number) {
    uint word = visible[number], slot = order[number];
    if (word >> kArenaBits != arena) return;
    uint level = placeLevel(meshSections[slot].place);
    vec3 corner = vec3(chunkCorner(meshSections[slot].chunk, level, cull.cameraChunk),
                       float(placeBase(meshSections[slot].place)));
    for (uint range = 0u; range < kTestedRanges; ++range) {
        uvec2 part = meshSections[slot].ranges[range];
        uint direction = min(range % kRangesOfTwoBuckets, kFaceDirections - 1u);
        bool isTwoSided = range % kRangesOfTwoBuckets == kFaceDirections;
        if ((word >> (kBlendedDirectionBits + direction) & 1u) == 0u) continue;
        bool isDrawnEarly = (word >> (kDrawnEarlyBits + direction) & 1u) != 0u, isAnySeen = false, isAnyNew = false;
        for (uint k = gl_LocalInvocationID.x; k < part.y; k += kQuadCullThreads) {
            uint at = part.x - arena * cull.arenaQuads + k;
            Quad quad = quads[at];
            bvec2 nowAndSoon = isVisible(quad, isTwoSided, corner, columnBlocks(level));
            bool isSeen = any(nowAndSoon), isNew = nowAndSoon.x && !(isDrawnEarly && (quad.word1 & kQuadSeen) != 0u);
            uint bits = (isSeen ? kQuadSeen : 0u) | (isNew ? kQuadNew : 0u);
            if ((quad.word1 & (kQuadSeen | kQuadNew)) != bits) quads[at].word1 = (quad.word1 & ~(kQuadSeen | kQuadNew)) | bits;
            isAnySeen = isAnySeen || isSeen;
            isAnyNew = isAnyNew || isNew;
        }
        if (isAnySeen) atomicOr(visibleLastFrame[slot], 1u << direction);
        if (isAnyNew) atomicOr(visible[number], 1u << (kOpaqueDirectionBits + direction));
    }
}

void main() {
    for (uint k = gl_WorkGroupID.x; k < tested.count; k += gl_NumWorkGroups.x) testMeshSection(testedNumbers[k]);
}
