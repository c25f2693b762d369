// The area that is solved: its blocks and its levels in cells of 8³.
#include "terrane/shared/light_solver.h"
#include "terrane/shared/packed_levels.h"

layout(location = 0) uniform uvec2 areaChunks;

layout(std430, binding = kSolverSectionsBinding) readonly buffer Sections {
    SectionInput sections[];  // by chunk (x fastest), sixteen each
};
layout(std430, binding = kSolverDataBinding) readonly buffer Data {
    uint data[];
};
layout(std430, binding = kSolverLevelsBinding) buffer Levels {
    uint levels[];  // by cell
};

uint cellIndex(uvec3 cell) {
    return cell.x + 2u * areaChunks.x * (cell.y + 2u * areaChunks.y * cell.z);
}

uvec3 cellPlace(uint index) {
    uvec2 size = 2u * areaChunks;
    return uvec3(index % size.x, index / size.x % size.y, index / (size.x * size.y));
}

bool isInside(ivec3 cell) {
    return all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, ivec3(2u * areaChunks, kCellsHigh)));
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
