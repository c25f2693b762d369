// The blocks of a batch: sections in their packed form, the types their ids stand for, and the units to mesh.
#include "terrane/shared/mesher.h"

layout(std430, binding = kMeshSectionsBinding) readonly buffer Sections {
    MeshSection sections[];
};
layout(std430, binding = kMeshDataBinding) readonly buffer Data {
    uint data[];
};
layout(std430, binding = kMeshTypesBinding) readonly buffer Types {
    MeshType types[];  // by id, the last stands for all ids from there on
};
layout(std430, binding = kMeshGrowthBinding) readonly buffer Growth {
    uint growth[];
};
layout(std430, binding = kMeshUnitsBinding) readonly buffer Units {
    MeshUnit units[];
};

uint typeOf(uint id) {
    return min(id, uint(types.length()) - 1u);
}

uint blockIndex(uvec3 cell) {
    return cell.x + 16u * cell.y + 256u * cell.z;
}

// Of a palette that is not needed the value itself.
uint packedAt(MeshSection section, uint block) {
    uint bit = block * section.bits;
    return data[section.words + (bit >> 5)] >> (bit & 31u) & ((1u << section.bits) - 1u);
}

// Id and, from bit 16 on, flags.
uint blockAt(MeshSection section, uint block) {
    if (section.bits == 0u) return data[section.palette];
    uint value = packedAt(section, block);
    return section.bits == 16u ? value | types[typeOf(value)].flags << 16 : data[section.palette + value];
}

uint smallDataAt(uint section, uint block) {
    if (section == kNoSection) return 0u;
    MeshSection from = sections[section];
    if (from.bits == 0u) return data[from.palette];
    uint value = packedAt(from, block);
    return from.bits == 16u ? value : data[from.palette + value];
}

uint blockBeyond(uint section, uvec3 cell) {
    if (section == kNoSection) return 0u;
    if (section == kOpaqueSection) return kMeshOpaqueBit << 16;
    return blockAt(sections[section], blockIndex(cell));
}
