// Output of quads. A first run counts them by mesh section and range; after the host has made room, a second run writes
// them into the buffer that is drawn from. WRITES_QUADS: 0 counts, 1 writes.
#include "terrane/mesh_gpu/faces.glsl"
#include "terrane/shared/shape_face.h"

shared uint counters[kRangesPerMeshSection];  // quads so far, or where the next one goes

layout(std430, binding = kMeshUnitCountsBinding) buffer UnitCounts {
    uint unitCounts[];  // kMeshUnitWords a unit
};
#if WRITES_QUADS
layout(std430, binding = kMeshSectionCountsBinding) buffer Places {
    uint places[];  // by mesh section and range: where the next unit's quads go
};
layout(std430, binding = kMeshQuadsBinding) writeonly buffer Quads {
    uvec2 quads[];
};
#else
layout(std430, binding = kMeshSectionCountsBinding) buffer MeshSections {
    MeshSectionCounts meshSections[];
};
shared uint lowest, highest;  // layers with faces

void coverLayer(uint z) {
    atomicMin(lowest, z);
    atomicMax(highest, z + 1u);
}
#endif

// face: material and draw bucket. direction: of a one-sided face, as in mesh/draw_bucket.h.
void addQuad(uint word0, uint shapeFace, uint face, uint direction) {
    uint bucket = face >> 16;
    uint range = firstRange(bucket) + ((bucket & 1u) != 0u ? 0u : direction);
    uint at = atomicAdd(counters[range], 1u);
#if WRITES_QUADS
    quads[at] = uvec2(word0 | (shapeFace & 255u) << 16, (face & 0xFFFFu) | (shapeFace >> 8) << 16);
#endif
}

uint packCell(MeshUnit unit, uvec3 cell) {
    return cell.x | cell.y << 4 | (unit.baseZ + cell.z) << 8;
}

bool isCovered(uvec3 cell, uint side) {
    ivec3 at = ivec3(cell) + kToward[side] + 1;
    return (opaqueRows[at.y + int(kPaddedSize) * at.z] >> at.x & 1u) != 0u;
}

// Adds the faces of the form that the block state selects, without those hidden by opaque cubes. Returns whether there
// are any.
bool addModel(MeshUnit unit, uvec3 cell, MeshType type) {
    uint state = blockStateAt(unit.blockState, blockIndex(cell)) & type.forms >> 16;
    uint form = forms[(type.forms & 0xFFFFu) + state];
    bool isSeen = false;
    for (uint k = 0u; k < form >> 24; ++k) {
        uint face = forms[(form & 0xFFFFFFu) + k], hiddenBy = face >> kMeshFaceHiddenByShift & 7u;
        if (hiddenBy < 6u && isCovered(cell, hiddenBy)) continue;
        uint look = type.faces[face >> kMeshFaceLookShift & 7u];
        if ((face & kMeshFaceTwoSidedBit) != 0u) look |= 1u << 16;  // the bucket of two-sided faces
        addQuad(packCell(unit, cell), face & (kMaxShapeFaces - 1u), look, face >> kMeshFaceDirectionShift & 7u);
        isSeen = true;
    }
    return isSeen;
}

// Adds one quad for each block and plane. Planes have the direction of their side; those of a cross have none.
void addPlanes(MeshUnit unit, uint planes, uint local) {
    bool isSeen = false;
    for (uint left = planes; left != 0u; left &= left - 1u) {
        uvec3 cell = uvec3(findLSB(left), local % kSectionSize, local / kSectionSize);
        MeshType type = types[typeOf(idAt(cell))];
        uint shape = type.flags & kMeshShapeMask, stages = type.forms >> 16, stage = 0u;
        if (shape == kMeshShapeModel) {
            isSeen = addModel(unit, cell, type) || isSeen;
            continue;
        }
        isSeen = true;
        if (stages > 0u) stage = min(blockStateAt(unit.blockState, blockIndex(cell)), stages);
        uint firstFace = shape == kMeshShapeCross  ? kShapeFaceCross
                         : shape == kMeshShapeHash ? kShapeFaceHash
                                                   : kShapeFaceInset;
        for (uint k = 0u; k < (shape == kMeshShapeCross ? 2u : 4u); ++k) {
            uint face = stage == 0u ? type.faces[k] : forms[(type.forms & 0xFFFFu) + stage - 1u];
            addQuad(packCell(unit, cell), firstFace + k, face, shape == kMeshShapeCross ? kFaceDirections - 1u : k);
        }
    }
#if !WRITES_QUADS
    if (isSeen) coverLayer(local / kSectionSize);
#endif
}

// Adds a quad of bits × rows faces, from this cell on.
void addFaces(MeshUnit unit, uint side, uvec3 cell, uvec2 extent) {
    MeshType type = types[typeOf(idAt(cell))];
    uint shapeFace = kShapeFaceCube + side;
    if ((type.flags & kMeshShapeMask) == kMeshShapeLiquid) {
        bool isSurface = (surface[cell.y + kSectionSize * cell.z] >> cell.x & 1u) != 0u;
        if (side == 5u) shapeFace = kShapeFaceLiquidTop;
        if (side < 4u && isSurface) shapeFace = kShapeFaceLiquidSide + side;
    }
    uint word0 = packCell(unit, cell) | (extent.x - 1u) << 24 | (extent.y - 1u) << 28;
    addQuad(word0, shapeFace, type.faces[side], side);
}
