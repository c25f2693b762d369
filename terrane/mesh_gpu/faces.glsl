// Finds the visible faces of a unit: rows of bits, as in the CPU mesher. An invocation has the row of blocks y, z = its
// index; planes are filled from rows.
#include "terrane/shared/mesher.h"
#include "terrane/shared/packed_section.glsl"

// The blocks of a batch: sections in their packed form, the types their ids stand for, and the units to mesh.
layout(std430, binding = kMeshTypesBinding) readonly buffer Types {
    MeshType types[];  // by id, the last stands for all ids from there on
};
layout(std430, binding = kMeshFormsBinding) readonly buffer Forms {
    uint forms[];  // see MeshType
};
layout(std430, binding = kMeshUnitsBinding) readonly buffer Units {
    MeshUnit units[];
};

uint typeOf(uint id) {
    return min(id, uint(types.length()) - 1u);
}

uint blockIndex(uvec3 cell) {
    return cell.x + kSectionSize * cell.y + kBlocksPerLayer * cell.z;
}

// Id and, from bit 16 on, flags of a block.
uint blockAt(PackedSection section, uint block) {
    uint value = packedValue(section, block);
    return section.bits == kDenseBits ? value | types[typeOf(value)].flags << 16 : value;
}

uint blockStateAt(uint section, uint block) {
    return section == kNoSection ? 0u : packedValue(sections[section], block);
}

uint blockBeyond(uint section, uvec3 cell) {
    if (section == kNoSection) return 0u;
    if (section == kOpaqueSection) return kMeshOpaqueBit << 16;
    return blockAt(sections[section], blockIndex(cell));
}

const uint kLast = kSectionSize - 1u;
const uint kPaddedSize = kSectionSize + 2u;  // with one block around

shared uint ids[kBlocksPerSection / 2u];            // of the section's blocks, two a word
shared uint opaqueRows[kPaddedSize * kPaddedSize];  // by y + 1 + 18·(z + 1), bit x + 1: opaque cubes
shared uint faces[6u * kBlocksPerLayer];  // visible, by side, then row·16 + plane: bits along u (y or x)
shared uint surface[kBlocksPerLayer];     // by y + 16 z, bits along x: liquid blocks whose top is visible

// Bits of an invocation's row of blocks.
struct Row {
    uint opaque, sides, inset, planes, liquid;
    uint flowing;  // liquid blocks that flow
};

uint idAt(uvec3 cell) {
    uint block = blockIndex(cell);
    return ids[block >> 1] >> (16u * (block & 1u)) & 0xFFFFu;
}

// x, y, z of a bit of a plane.
uvec3 cellOf(uint side, uint plane, uint row, uint bit) {
    if (side < 2u) return uvec3(plane, bit, row);
    return side < 4u ? uvec3(bit, plane, row) : uvec3(bit, row, plane);
}

Row readRow(MeshUnit unit, uint local) {
    PackedSection section = sections[unit.section];
    Row row = Row(0u, 0u, 0u, 0u, 0u, 0u);
    for (uint x = 0u; x < kSectionSize; x += 2u) {
        uint pair = 0u;
        for (uint k = 0u; k < 2u; ++k) {
            uint block = blockAt(section, kSectionSize * local + x + k), flags = block >> 16, bit = 1u << (x + k);
            uint shape = flags & kMeshShapeMask;
            pair |= (block & 0xFFFFu) << (16u * k);
            if ((flags & kMeshOpaqueBit) != 0u) row.opaque |= bit;
            if (shape == kMeshShapeCube || shape == kMeshShapeLiquid) row.sides |= bit;
            if (shape == kMeshShapeLiquid) row.liquid |= bit;
            if (shape == kMeshShapeInset) row.inset |= bit;
            if (shape >= kMeshShapeCross) row.planes |= bit;
        }
        ids[kSectionSize / 2u * local + (x >> 1)] = pair;
    }
    for (uint left = row.liquid; unit.blockState != kNoSection && left != 0u; left &= left - 1u) {
        uint x = uint(findLSB(left));
        if ((blockStateAt(unit.blockState, kSectionSize * local + x) & kMeshFlowMask) != 0u) row.flowing |= 1u << x;
    }
    return row;
}

bool isOpaqueBeyond(MeshUnit unit, uint side, uvec3 cell) {
    return (blockBeyond(unit.neighbors[side], cell) & kMeshOpaqueBit << 16) != 0u;
}

// Writes the rows with the blocks around the section to shared memory. Rows outside the section are zero before.
void shareOpaque(MeshUnit unit, Row row, uint local) {
    uint a = local % kSectionSize, b = local / kSectionSize;
    uint bits = row.opaque << 1;
    if (isOpaqueBeyond(unit, 0u, uvec3(kLast, a, b))) bits |= 1u;
    if (isOpaqueBeyond(unit, 1u, uvec3(0u, a, b))) bits |= 1u << (kSectionSize + 1u);
    opaqueRows[a + 1u + kPaddedSize * (b + 1u)] = bits;
    uint bit = 2u << a;
    if (isOpaqueBeyond(unit, 2u, uvec3(a, kLast, b))) atomicOr(opaqueRows[kPaddedSize * (b + 1u)], bit);
    if (isOpaqueBeyond(unit, 3u, uvec3(a, 0u, b))) atomicOr(opaqueRows[kSectionSize + 1u + kPaddedSize * (b + 1u)], bit);
    if (isOpaqueBeyond(unit, 4u, uvec3(a, b, kLast))) atomicOr(opaqueRows[b + 1u], bit);
    if (isOpaqueBeyond(unit, 5u, uvec3(a, b, 0u))) atomicOr(opaqueRows[b + 1u + kPaddedSize * (kSectionSize + 1u)], bit);
}

const ivec3 kToward[6] = ivec3[](ivec3(-1, 0, 0), ivec3(1, 0, 0), ivec3(0, -1, 0), ivec3(0, 1, 0), ivec3(0, 0, -1),
                                 ivec3(0, 0, 1));

uint idBeside(MeshUnit unit, uvec3 cell, uint side) {
    ivec3 at = ivec3(cell) + kToward[side];
    uvec3 inside = uvec3(at & int(kLast));
    if (all(equal(ivec3(inside), at))) return idAt(inside);
    return blockBeyond(unit.neighbors[side], inside) & 0xFFFFu;
}

// Finds the faces of a row toward blocks that are not opaque cubes, nor of the same type where that hides them.
void findSeen(MeshUnit unit, Row row, uint local, out uint seen[6]) {
    uint at = local % kSectionSize + 1u + kPaddedSize * (local / kSectionSize + 1u), own = opaqueRows[at];
    uint beyond[6] = uint[](own, own >> 2, opaqueRows[at - 1u] >> 1, opaqueRows[at + 1u] >> 1,
                            opaqueRows[at - kPaddedSize] >> 1, opaqueRows[at + kPaddedSize] >> 1);
    uint any = 0u;
    for (uint side = 0u; side < 6u; ++side) {
        seen[side] = (side < 4u ? row.sides : row.sides | row.inset) & ~beyond[side];
        any |= seen[side];
    }
    for (uint left = any & ~row.opaque; left != 0u; left &= left - 1u) {
        uint x = uint(findLSB(left)), id = idAt(uvec3(x, local % kSectionSize, local / kSectionSize));
        uint hides = types[typeOf(id)].flags >> kMeshHidesShift;
        for (uint side = 0u; side < 6u; ++side) {
            if ((hides >> side & 1u) == 0u || (seen[side] >> x & 1u) == 0u) continue;
            if (idBeside(unit, uvec3(x, local % kSectionSize, local / kSectionSize), side) == id) seen[side] &= ~(1u << x);
        }
    }
}

// Faces of flowing blocks are added by liquids.glsl.
void leaveOutFlowing(Row row, inout uint seen[6]) {
    for (uint side = 0u; side < 6u; ++side) seen[side] &= ~row.flowing;
}

// Writes the visible faces to the planes. On sides of x the bits of a row along x belong to 16 rows along y: they are
// few, and set one by one.
void shareSeen(uint seen[6], uint local) {
    uint y = local % kSectionSize, z = local / kSectionSize;
    for (uint side = 0u; side < 2u; ++side) {
        for (uint left = seen[side]; left != 0u; left &= left - 1u) {
            atomicOr(faces[kBlocksPerLayer * side + kSectionSize * z + uint(findLSB(left))], 1u << y);
        }
    }
    for (uint side = 2u; side < 4u; ++side) faces[kBlocksPerLayer * side + kSectionSize * z + y] = seen[side];
    for (uint side = 4u; side < 6u; ++side) faces[kBlocksPerLayer * side + kSectionSize * y + z] = seen[side];
}
