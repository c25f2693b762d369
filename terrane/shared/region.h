// The regions of chunks as the GPU culls and draws them: records, lists of draw commands, counts.
#ifndef TERRANE_SHARED_REGION_H
#define TERRANE_SHARED_REGION_H

#include "terrane/shared/constants.h"
#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kFaceContexts = 6u;  // mesh::kContextCount
const uint kFaceGroups = 7u;    // mesh::kGroupCount

// Quads of a region, one range for each context and group of faces. Two-sided contexts (the odd ones) have
// faces of the last group only.
const uint kRangesOfTwoContexts = 8u;
const uint kRangesOfRegion = 24u;

SHARED_FN uint firstRange(uint context) {
    return (context >> 1) * kRangesOfTwoContexts + (context & 1u) * kFaceGroups;
}

struct RegionRecord {
    ivec2 chunk;                    // in chunks of the level
    uint level;                     // see world::ChunkPos
    uint heights;                   // lowest block, and the block above the highest << 16
    uvec2 ranges[kRangesOfRegion];  // first quad in the buffer, count
};

// Width of a column of a level, in blocks.
SHARED_FN float columnBlocks(uint level) {
    return float(1u << level);
}

// The lowest corner of a chunk, in blocks from the corner of the camera's chunk of level 0: exact near the
// camera, wherever in the world that is.
SHARED_FN vec2 chunkCorner(ivec2 chunk, uint level, ivec2 cameraChunk) {
    return float(kChunkSize) * vec2((chunk << int(level)) - cameraChunk);
}

// As glMultiDrawElementsIndirect reads it.
struct DrawCommand {
    uint indexCount;
    uint instanceCount;
    uint firstIndex;
    int baseVertex;     // 4 × first quad
    uint baseInstance;  // number of the region
};

// Quads that a command can draw: four vertices each within 16-bit indices.
const uint kMaxQuadsPerCommand = 16384u;

// Lists of commands: those of the camera by context, then those of the shadow map, which has none of blended
// faces.
const uint kCameraLists = 6u;
const uint kShadowLists = 4u;
const uint kDrawLists = 10u;

// Commands and quads of each list, then regions in sight.
struct DrawCounts {
    uint commands[kDrawLists];
    uint quads[kDrawLists];
    uint regions;
};

// Bits of a region's word of visibility: groups of faces to draw for the camera, for the shadow map, and of
// blended faces.
const uint kCameraGroupBits = 0u;
const uint kShadowGroupBits = 8u;
const uint kBlendedGroupBits = 16u;

// What a run of culling draws. Where regions behind others are left out there are two: those that were seen
// in the frame before, then, behind the depth of these, those that are seen now.
const uint kCullAll = 0u;
const uint kCullSeenBefore = 1u;
const uint kCullSeenNow = 2u;

// How far leaves and plants may leave the box of their region, in blocks.
const float kWaving = 0.25f;

// Threads of a work group: regions of cull.comp.glsl, texels a side of depth_pyramid.comp.glsl.
const uint kCullThreads = 64u;
const uint kPyramidThreads = 8u;

// The pyramid of depths: its finest texels are as many pixels a side, each next level twice as many.
const uint kPyramidTexel = 8u;

// What culling needs to know. A plane (a, w) holds the points p with dot(a, p) + w ≥ 0.
struct CullFrame {
    vec4 cameraPlanes[5];
    vec4 shadowPlanes[5];
    vec4 cameraPosition;    // from the corner of its chunk
    vec4 lightDirection;    // to the light
    uvec4 firstCommand[3];  // of each list, in the buffer of commands
    mat4 viewProjection;
    ivec2 cameraChunk;
    vec2 viewportSize;  // pixels
    float nearPlane;    // blocks
    int pyramidLevels;
    uint regionCount;
    uint run;  // kCullAll and so on
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(RegionRecord) == 16 + 8 * kRangesOfRegion);
static_assert(sizeof(DrawCommand) == 20);
static_assert(sizeof(CullFrame) == 21 * 16);
}  // namespace terrane::shared
#endif
#endif
