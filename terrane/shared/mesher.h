// Constants and records shared by the host and the shaders that mesh (terrane/mesh_gpu).
#ifndef TERRANE_SHARED_MESHER_H
#define TERRANE_SHARED_MESHER_H

#include "terrane/shared/constants.h"
#include "terrane/shared/language.h"
#include "terrane/shared/mesh_section.h"

SHARED_BEGIN

// Storage buffers, after those of shared/packed_section.h
const uint kMeshTypesBinding = 2u;
const uint kMeshFormsBinding = 3u;
const uint kMeshUnitsBinding = 4u;
const uint kMeshUnitCountsBinding = 5u;
const uint kMeshSectionCountsBinding = 6u;  // counts, or places of the next quads
const uint kMeshQuadsBinding = 7u;

// Palettes of packed sections of blocks hold the id and, from bit 16 on, the flags of its type; those of
// block state hold values.

// Place of a mesh section whose quads are not written.
const uint kNoPlace = 0xFFFFFFFFu;

// Section numbers without a section
const uint kNoSection = 0xFFFFFFFFu;      // air, or no block state
const uint kOpaqueSection = 0xFFFFFFFEu;  // below the world

// Work of one work group: the part of a section that lies in one mesh section.
struct MeshUnit {
    uint section;
    uint blockState;
    uint meshSection;  // of all mesh sections of the batch
    uint layers;       // of the section: the first, and the one after the last << 16
    uint neighbors[6];
    uint neighborStates[4];
    uint baseZ;  // of the section, in its slab (quad.h)
    uint unused;
};

// A block type: its flags, and for each side the material and, from bit 16 on, its draw bucket. In the list
// of forms it has from `forms` & 0xFFFF on:
//   - a plant that grows: material and bucket of each stage, `forms` >> 16 of them,
//   - a model: for each value of the state's bits in the mask `forms` >> 16 the index of its first face in
//     the list, and from bit 24 on the number of its faces.
// A face of a model: bits 0–10 the shape face, 11–13 the side whose material it has, 14–16 the side on which
// an opaque cube hides it (6: none does), 17–19 its direction, 20 whether it is two-sided.
struct MeshType {
    uint flags;
    uint forms;
    uint faces[6];
};

// Flags: the shape as world::Shape numbers it, whether it is an opaque cube, then a bit each side.
const uint kMeshShapeMask = 7u;
const uint kMeshOpaqueBit = 8u;
const uint kMeshHidesShift = 4u;    // no face toward the same type
const uint kMeshMergesShift = 10u;  // faces may become one quad
const uint kMeshShapeCube = 1u;
const uint kMeshShapeLiquid = 2u;
const uint kMeshShapeCross = 3u;
const uint kMeshShapeHash = 4u;
const uint kMeshShapeInset = 5u;
const uint kMeshShapeModel = 6u;

// Block state of liquids, as world/changes/liquid_flow.h has it
const uint kMeshFlowMask = 15u;
const uint kMeshFlowFalling = 8u;

const uint kMeshFaceLookShift = 11u;
const uint kMeshFaceHiddenByShift = 14u;
const uint kMeshFaceDirectionShift = 17u;
const uint kMeshFaceTwoSidedBit = 1u << 20;

// Words of a unit: its number of quads by range, then one that is 0 if it has no faces.
const uint kMeshUnitWords = 25u;

struct MeshSectionCounts {
    uint quads[kRangesPerMeshSection];
    uint minZ;  // as in mesh::MeshSection, in its slab; above maxZ if there are no quads
    uint maxZ;
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(MeshUnit) == 64 && sizeof(MeshType) == 32);
static_assert(sizeof(MeshSectionCounts) == 4 * (kRangesPerMeshSection + 2));
static_assert(kMeshUnitWords == kRangesPerMeshSection + 1);
}  // namespace terrane::shared
#endif
#endif
