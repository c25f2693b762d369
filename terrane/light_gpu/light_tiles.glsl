// The solved chunks: their blocks, and their light levels in light tiles of 8³.
#include "terrane/shared/light_solver.h"
#include "terrane/shared/packed_light_levels.h"
#include "terrane/shared/packed_section.glsl"

layout(location = 0) uniform uint chunkCount;

layout(std430, binding = kSolverLightLevelsBinding) buffer LightLevels {
    uint levels[];  // by light tile
};

uint tileCount() {
    return kLightTilesPerChunk * chunkCount;
}

// `place` counts light tiles in the chunk, 2 × 2 × 32 of them.
uint tileIndex(uint chunk, uvec3 place) {
    return chunk * kLightTilesPerChunk + place.x + 2u * place.y + 4u * place.z;
}

// Corner of a light tile in its chunk, in blocks.
uvec3 tileCorner(uint tile) {
    return kLightTileSize * uvec3(tile & 1u, tile >> 1 & 1u, tile >> 2 & (kLightTilesHigh - 1u));
}

uint wordIndex(uint tile, uvec3 word) {
    return tile * kLightTileWords + word.x + kLightTileWordsX * (word.y + kLightTileSize * word.z);
}

// Opacity and emission of a block; x and y in the chunk, which has sixteen sections.
uint propertyAt(uint chunk, uvec3 block) {
    PackedSection section = sections[chunk * kSectionsPerChunk + block.z / kSectionSize];
    return packedValue(section, block.x + kChunkSize * block.y + kBlocksPerLayer * (block.z % kSectionSize));
}
