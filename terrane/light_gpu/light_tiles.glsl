// The solved chunks: their blocks, and their light levels in light tiles of 8³. The sections that are solved are the
// same in all chunks of a batch, and are numbered from below.
#include "terrane/shared/light_solver.h"
#include "terrane/shared/packed_light_levels.h"
#include "terrane/shared/packed_section.glsl"
#include "terrane/light_gpu/solver_state.glsl"

layout(std430, binding = kSolverLightLevelsBinding) buffer LightLevels {
    uint levels[];  // by light tile
};

uint tilesPerChunk() {
    return kLightTilesPerSection * sectionCount;
}

uint tileCount() {
    return tilesPerChunk() * chunkCount;
}

// `place` counts light tiles in the chunk, 2 × 2 of them in a layer.
uint tileIndex(uint chunk, uvec3 place) {
    return chunk * tilesPerChunk() + place.x + 2u * place.y + 4u * place.z;
}

uint wordIndex(uint tile, uvec3 word) {
    return tile * kLightTileWords + word.x + kLightTileWordsX * (word.y + kLightTileSize * word.z);
}

// Opacity and emission of a block; x and y in the chunk, z from its lowest solved section.
uint propertyAt(uint chunk, uvec3 block) {
    PackedSection section = sections[chunk * sectionCount + block.z / kSectionSize];
    return packedValue(section, block.x + kChunkSize * block.y + kBlocksPerLayer * (block.z % kSectionSize));
}
