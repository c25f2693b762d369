// The mesh sections of chunks as the GPU culls and draws them: records, lists of draw commands, counts.
#ifndef TERRANE_SHARED_MESH_SECTION_H
#define TERRANE_SHARED_MESH_SECTION_H

#include "terrane/shared/constants.h"
#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kDrawBuckets = 6u;     // mesh::kDrawBucketCount
const uint kFaceDirections = 7u;  // mesh::kFaceDirectionCount

// Quads of a mesh section, one range for each draw bucket and face direction. Two-sided buckets (the odd
// ones) have faces of the last direction only.
const uint kRangesOfTwoBuckets = 8u;
const uint kRangesPerMeshSection = 24u;

SHARED_FN uint firstRange(uint bucket) {
    return (bucket >> 1) * kRangesOfTwoBuckets + (bucket & 1u) * kFaceDirections;
}

struct MeshSectionRecord {
    ivec2 chunk;                          // in chunks of the level
    uint place;                           // level and slab, see packPlace()
    uint heights;                         // see packHeights()
    uvec2 ranges[kRangesPerMeshSection];  // address of the first quad (gpu/arena_allocator.h), count
};

// The level of a mesh section's chunk (world::ChunkPos) in bits 0–7, and above them the slab of its quads
// (quad.h), which may be negative.
SHARED_FN uint packPlace(uint level, int slab) {
    return level | (uint(slab) << 8);
}
SHARED_FN uint placeLevel(uint place) {
    return place & 255u;
}
SHARED_FN int placeBase(uint place) {  // lowest layer of the slab
    return int(place & ~255u);
}

// The lowest block of a mesh section with quads in the lower 16 bits, and the block above the highest in the
// upper ones; both may be negative.
SHARED_FN uint packHeights(int low, int high) {
    return (uint(low) & 65535u) | (uint(high) << 16);
}
SHARED_FN int lowHeight(uint heights) {
    return int(heights << 16) >> 16;
}
SHARED_FN int highHeight(uint heights) {
    return int(heights) >> 16;
}

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
    int baseVertex;     // 0: see DrawRecord
    uint baseInstance;  // number of its DrawRecord
};

// What the vertex shader knows of a draw, as an instance attribute. The first quad is not in the base vertex,
// so that vertex ids stay below 2¹⁶: some drivers have wrong ones from 2²³ on.
struct DrawRecord {
    ivec2 chunk;  // of the mesh section
    uint place;
    uint firstQuad;  // in its arena, or see kFirstListedQuad
};

// Quads that a command can draw: four vertices each within 16-bit indices.
const uint kMaxQuadsPerCommand = 16384u;

// Commands of all lists: base instances are exact in a float too. 2²³ × 36 bytes (DrawCommand, DrawRecord).
const uint kMaxDrawCommands = 1u << 23;

// Lists of commands, one for each draw bucket.
const uint kDrawLists = 6u;

// The first lists, of opaque and tested faces, draw lists of quads (render/cull/quad_list.h): their first
// quad is kFirstListedQuad + place in the list. No arena has as many quads.
const uint kListedDrawLists = 4u;
const uint kFirstListedQuad = 1u << 28;
const uint kMaxListedQuads = (1u << 28) - 1u;

// Quads lie in several buffers (arenas). Each arena has commands and counts of its own, since a draw call
// reads one buffer. 32 × 2²⁷ quads (1 GiB) are all that 32 bits can name.
const uint kMaxArenas = 32u;
const uint kFirstCommandVectors = 48u;  // kMaxArenas × kDrawLists / 4

// Commands and quads of each list, then mesh sections in sight; of one arena.
struct DrawCounts {
    uint commands[kDrawLists];
    uint quads[kDrawLists];
    uint meshSections;
};

// Bits of a mesh section's visibility word: face directions to draw, of opaque and tested faces and of
// blended faces, then the arena of its quads.
const uint kOpaqueDirectionBits = 0u;
const uint kDrawnEarlyBits = 8u;  // of the late pass: directions that the early one drew
const uint kBlendedDirectionBits = 16u;
const uint kArenaBits = 24u;

// Culling phases. Occlusion culling has two: early draws mesh sections that were visible in the frame before;
// late draws others that the depth of these (Hi-Z) does not hide.
const uint kCullAll = 0u;
const uint kCullEarly = 1u;
const uint kCullLate = 2u;

// Farthest that leaves and plants reach out of the box of their mesh section, in blocks.
const float kWaving = 0.25f;

// Threads of a work group: mesh sections of cull.comp.glsl, quads of quad_cull.comp.glsl, texels a side of
// hi_z.comp.glsl.
const uint kCullThreads = 64u;
const uint kQuadCullThreads = 32u;
const uint kHiZThreads = 8u;

// Hi-Z, the pyramid of farthest depths: its finest texels are as many pixels a side, each next level twice as
// many.
const uint kHiZTexelPixels = 2u;

// What the tests of boxes and quads read (culling.h).
struct CullView {
    mat4 viewProjection;
    vec2 viewportSize;    // pixels
    float nearPlane;      // blocks
    float edgeExpansion;  // pixels, as in Frame
    float blockPixels;    // pixels that a block takes, one block ahead
    uint samples;         // a pixel
    int hiZLevels;
    uint hidesBacks;  // 1: back sides of two-sided faces of cubes, which are leaves, are not drawn
};

// Uniforms of culling. A plane (a, w) holds the points p with dot(a, p) + w ≥ 0.
struct CullFrame {
    vec4 cameraPlanes[5];
    vec4 cameraPosition;                       // from the corner of its chunk
    uvec4 firstCommand[kFirstCommandVectors];  // by arena × kDrawLists + list, in the buffer of commands
    CullView view;
    ivec2 cameraChunk;
    uint meshSectionCount;
    uint phase;          // kCullAll and so on
    uint arenaQuads;     // addresses of an arena
    uint commandsEnd;    // of the last list
    uint maxTestGroups;  // of quad_cull.comp.glsl
    uint unused;
};

// Mesh sections whose quads are to be tested: work groups, as glDispatchComputeIndirect reads them, and their
// number; their places in the order follow. A work group tests every groups-th of them.
struct TestedMeshSections {
    uint groups;
    uint one1, one2;
    uint count;
};

// Work groups that OpenGL guarantees.
const uint kMaxTestGroups = 65535u;

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(MeshSectionRecord) == 16 + 8 * kRangesPerMeshSection);
static_assert(sizeof(DrawCommand) == 20);
static_assert(sizeof(DrawRecord) == 16);
static_assert(sizeof(CullFrame) == (14 + kFirstCommandVectors) * 16);
static_assert(4 * kFirstCommandVectors == kMaxArenas * kDrawLists);
}  // namespace terrane::shared
#endif
#endif
