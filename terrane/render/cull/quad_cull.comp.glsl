// Tests the quads of mesh sections for visibility against Hi-Z: a work group for a mesh section (or for several, if
// there are more than work groups), a thread for a quad.
// Writes two bits of each quad (cull_pass.h), and the directions of the mesh section that have quads with them.
#include "terrane/shared/bindings.h"
#include "terrane/shared/material.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/shared/quad.h"
#include "terrane/shared/shape_face.h"
#include "terrane/shared/frame.h"
#include "terrane/render/frame/edge_expansion.glsl"

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
const float kRounding = 1.0 / 64.0;                   // pixels

// Bounds of a quad on the screen, in pixels, and the depth of its nearest corner.
struct Footprint {
    vec2 low, high;
    float nearest;
    bool isBefore;  // all corners are in front of the camera
};

vec2 directionTo(vec2 v) {
    return v / max(length(v), 1e-6);
}

// `slabCorner`: of the chunk, at the lowest layer of the quad's slab.
Footprint footprintOf(Quad quad, vec3 slabCorner, float columnWidth) {
    uint number = quadShapeFace(quad);
    int face = 4 * int(number);
    ShapeFace shape = ShapeFace(texelFetch(shapeFaces, face), texelFetch(shapeFaces, face + 1),
                                texelFetch(shapeFaces, face + 2), flatBend());
    if (number >= kShapeFaceCount) shape.bend = texelFetch(shapeFaces, face + 3);
    vec2 extent = vec2(quadExtentU(quad), quadExtentV(quad));
    vec3 cellBlocks = vec3(vec2(columnWidth), 1.0);
    vec4 cell = vec4(quadX(quad), quadY(quad), quadZ(quad), 0.0);
    vec3 corner = cellBlocks * shapeFaceCorner(shape, cell, vec2(0.0), extent).xyz + slabCorner;
    vec4 clip[4];
    clip[0] = cull.viewProjection * vec4(corner, 1.0);
    vec4 alongU = cull.viewProjection * vec4(cellBlocks * shape.axisU.xyz * extent.x, 0.0);
    vec4 alongV = cull.viewProjection * vec4(cellBlocks * shape.axisV.xyz * extent.y, 0.0);
    clip[1] = clip[0] + alongU;
    clip[2] = clip[0] + alongV;
    clip[3] = clip[1] + alongV + cull.viewProjection * vec4(cellBlocks * shape.bend.xyz, 0.0);
    // Waving faces may move in every direction. The vertex shader reads the same materials.
    bool isWaving = texelFetch(materials, int(quadMaterial(quad))).b != kAnimationNone;
    float waving = isWaving ? kWaving : 0.0;
    float least = min(min(clip[0].w, clip[1].w), min(clip[2].w, clip[3].w)) - waving;
    Footprint print;
    print.isBefore = least > 2.0 * cull.nearPlane;
    vec2 at[4];
    for (int k = 0; k < 4; ++k) at[k] = (0.5 + 0.5 * clip[k].xy / clip[k].w) * cull.viewportSize;
    // Edges move outward, farther at sharp corners (edge_expansion.glsl). Twice that is used, since corners differ.
    vec2 u = directionTo(at[1] - at[0]), v = directionTo(at[2] - at[0]);
    float sine = abs(u.x * v.y - u.y * v.x);
    float margin = kRounding + 4.0 * cull.edgeExpansion * min(1.0 / max(sine, 1e-6), kLongestMiter) +
                   waving * cull.blockPixels / max(least, cull.nearPlane);
    print.low = min(min(at[0], at[1]), min(at[2], at[3])) - margin;
    print.high = max(max(at[0], at[1]), max(at[2], at[3])) + margin;
    print.nearest = 1.0001 * cull.nearPlane / max(least, cull.nearPlane);
    return print;
}

// Quads hidden by less than this share of their distance, or this little outside the image, may become visible in the
// next frames: the early pass draws them, so that the late pass has less to draw.
const float kSoon = 0.99;
const float kSoonPixels = 32.0;

// With one sample a pixel is drawn if its center is covered.
bool hasSample(Footprint print) {
    if (cull.samples > 1u) return true;
    return all(lessThanEqual(ceil(print.low - 0.5), floor(print.high - 0.5)));
}

bool isInView(Footprint print, float margin) {
    return all(greaterThanEqual(print.high, vec2(-margin))) && all(lessThanEqual(print.low, cull.viewportSize + margin));
}

// Whether the drawn depth hides the quad now, and whether it probably still does in the next frames.
bvec2 isBehind(Footprint print) {
    ivec2 first = ivec2(clamp(print.low, vec2(0.0), cull.viewportSize - 1.0)) / int(kHiZTexelPixels);
    ivec2 last = ivec2(clamp(print.high, vec2(0.0), cull.viewportSize - 1.0)) / int(kHiZTexelPixels);
    ivec2 size = last - first;
    // Two or three texels along a side, or one.
    int level = clamp(findMSB(max(max(size.x, size.y), 1)), 0, cull.hiZLevels - 1);
    first >>= level;
    last >>= level;
    float farthest = 1.0;
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) farthest = min(farthest, texelFetch(hiZ, ivec2(x, y), level).r);
    }
    return bvec2(print.nearest < farthest, print.nearest < kSoon * farthest);
}

// Whether a quad can be seen now, and whether it may be soon.
bvec2 isVisible(Quad quad, vec3 slabCorner, float columnWidth) {
    Footprint print = footprintOf(quad, slabCorner, columnWidth);
    if (!print.isBefore) return bvec2(true);
    bvec2 behind = isBehind(print);
    return bvec2(isInView(print, 0.0) && hasSample(print) && !behind.x, isInView(print, kSoonPixels) && !behind.y);
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
        if ((word >> (kBlendedDirectionBits + direction) & 1u) == 0u) continue;
        bool isDrawnEarly = (word >> (kDrawnEarlyBits + direction) & 1u) != 0u, isAnySeen = false, isAnyNew = false;
        for (uint k = gl_LocalInvocationID.x; k < part.y; k += kQuadCullThreads) {
            uint at = part.x - arena * cull.arenaQuads + k;
            Quad quad = quads[at];
            bvec2 nowAndSoon = isVisible(quad, corner, columnBlocks(level));
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
