// The blocks of a batch: sections in their packed form, the types their ids stand for, and the units to mesh.
#include "terrane/shared/mesher.h"
#include "terrane/shared/packed_section.glsl"

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
