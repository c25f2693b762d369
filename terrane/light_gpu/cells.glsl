// The chunks that are solved: their blocks and their levels in cells of 8³.
#include "terrane/shared/light_solver.h"
#include "terrane/shared/packed_levels.h"

layout(location = 0) uniform uint chunkCount;

layout(std430, binding = kSolverSectionsBinding) readonly buffer Sections {
    SectionInput sections[];  // by chunk, sixteen each
};
layout(std430, binding = kSolverDataBinding) readonly buffer Data {
    uint data[];
};
layout(std430, binding = kSolverLevelsBinding) buffer Levels {
    uint levels[];  // by cell
};

uint cellCount() {
    return kCellsPerChunk * chunkCount;
}

// `place` counts cells in the chunk, 2 × 2 × 32 of them.
uint cellIndex(uint chunk, uvec3 place) {
    return chunk * kCellsPerChunk + place.x + 2u * place.y + 4u * place.z;
}

// Of its chunk, in blocks.
uvec3 cellCorner(uint cell) {
    return kCellSize * uvec3(cell & 1u, cell >> 1 & 1u, cell >> 2 & (kCellsHigh - 1u));
}

uint wordIndex(uint cell, uvec3 word) {
    return cell * kCellWords + word.x + kCellWordsX * (word.y + kCellSize * word.z);
}

// Opacity and emission of a block; x and y in the chunk.
uint propertyAt(uint chunk, uvec3 block) {
    SectionInput section = sections[chunk * kSectionsPerChunk + (block.z >> 4)];
    if (section.bits == 0u) return data[section.palette];
    uint bit = (block.x + 16u * block.y + 256u * (block.z & 15u)) * section.bits;
    uint value = data[section.words + (bit >> 5)] >> (bit & 31u) & ((1u << section.bits) - 1u);
    return section.bits == 16u ? value : data[section.palette + value];
}
