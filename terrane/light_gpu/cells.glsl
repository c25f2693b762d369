// The area that is solved: its blocks and its levels in cells of 8³.
#include "terrane/shared/light_solver.h"
#include "terrane/shared/packed_levels.h"
#include "terrane/shared/packed_section.glsl"

layout(location = 0) uniform uvec2 areaChunks;

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

// Opacity and emission of a block; x and y in the chunk. Sections lie by chunk (x fastest), sixteen each.
uint propertyAt(uint chunk, uvec3 block) {
    PackedSection section = sections[chunk * kSectionsPerChunk + block.z / kSectionSize];
    return packedValue(section, block.x + kChunkSize * block.y + kBlocksPerLayer * (block.z % kSectionSize));
}
