// The chunks that are solved: their blocks and their levels in cells of 8³.
#include "terrane/shared/light_solver.h"
#include "terrane/shared/packed_levels.h"
#include "terrane/shared/packed_section.glsl"

layout(location = 0) uniform uint chunkCount;

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

// Opacity and emission of a block; x and y in the chunk, which has sixteen sections..
uint propertyAt(uint chunk, uvec3 block) {
    PackedSection section = sections[chunk * kSectionsPerChunk + block.z / kSectionSize];
    return packedValue(section, block.x + kChunkSize * block.y + kBlocksPerLayer * (block.z % kSectionSize));
}
