// Inputs and outputs of an emitted pass: its column, fields, blocks, seeds. One work group is a chunk's 16×16 columns;
// the second dimension of the dispatch splits the layers of a 3D pass.
//
// Defined by the host: FIELD_COUNT, BLOCK_PASS_COUNT (3D passes whose blocks are kept), SOURCE_BLOCKS (which of them this
// pass reads), TARGET_BLOCKS (which it writes; -1: the result of the generator), LAYERS_PER_GROUP.
#include "terrane/shared/constants.h"
#include "terrane/shared/generation.h"

layout(local_size_x = kChunkSize, local_size_y = kChunkSize) in;

layout(std430, binding = kTileJobsBinding) readonly buffer TileJobs {
    TileJob jobs[];
};
layout(std430, binding = kFieldsBinding) buffer Fields {
    uint fields[];  // by slot, field, column
};
layout(std430, binding = kBlocksBinding) buffer Blocks {
    uint blocks[];  // by slot, pass, column, two layers a word
};
layout(std430, binding = kResultBinding) writeonly buffer Result {
    uint resultBlocks[];  // by job, column, two layers a word
};
layout(std430, binding = kNoiseSeedsBinding) readonly buffer NoiseSeeds {
    uint noiseSeeds[];
};
layout(std430, binding = kHashSeedsBinding) readonly buffer HashSeeds {
    uint hashSeeds[];
};

const uint kWordsPerColumn = kChunkHeight / 2u;

int columnX, columnY;
uint column;  // in the tile: x + 16 y
uint slot;
uint evenLayerBlock;  // waits for its odd neighbor

void beginTile() {
    TileJob job = jobs[gl_WorkGroupID.x];
    column = gl_LocalInvocationID.x + kChunkSize * gl_LocalInvocationID.y;
    columnX = job.origin.x + int(gl_LocalInvocationID.x) * job.origin.w;
    columnY = job.origin.y + int(gl_LocalInvocationID.y) * job.origin.w;
    slot = uint(job.origin.z);
}

int firstLayer() {
    return int(gl_WorkGroupID.y) * LAYERS_PER_GROUP;
}

int lastLayer() {
    return firstLayer() + LAYERS_PER_GROUP;
}

uint readField(uint field) {
    return fields[(slot * FIELD_COUNT + field) * kBlocksPerLayer + column];
}

void writeField(uint field, uint bits) {
    fields[(slot * FIELD_COUNT + field) * kBlocksPerLayer + column] = bits;
}

// A column of one of the nine chunks. Offsets beyond kMaxReadOffset are clamped, as on the CPU.
struct Place {
    uint slot, column;
};

Place placeAt(int dx, int dy) {
    uint x = gl_LocalInvocationID.x + kChunkSize + uint(clamp(dx, -kMaxReadOffset, kMaxReadOffset));
    uint y = gl_LocalInvocationID.y + kChunkSize + uint(clamp(dy, -kMaxReadOffset, kMaxReadOffset));
    uint neighbor = y / kChunkSize * 3u + x / kChunkSize;
    return Place(jobs[gl_WorkGroupID.x].neighbors[neighbor >> 2][neighbor & 3u],
                 x % kChunkSize + kChunkSize * (y % kChunkSize));
}

uint readFieldAt(uint field, int dx, int dy) {
    Place place = placeAt(dx, dy);
    return fields[(place.slot * FIELD_COUNT + field) * kBlocksPerLayer + place.column];
}

int readBlock(Place place, int z) {
    uint layer = uint(clamp(z, 0, int(kChunkHeight) - 1));
    uint columns = (place.slot * BLOCK_PASS_COUNT + SOURCE_BLOCKS) * kBlocksPerLayer + place.column;
    uint word = blocks[columns * kWordsPerColumn + layer / 2u];
    return int((layer & 1u) == 0u ? word & 0xFFFFu : word >> 16);
}

int blockInColumn(int z) {
    return readBlock(Place(slot, column), z);
}

int blockAt(int dx, int dy, int z) {
    return readBlock(placeAt(dx, dy), z);
}

int blockHere(int z) {
    return blockInColumn(z);
}

void writeBlock(int z, uint block) {
    if ((z & 1) == 0) {
        evenLayerBlock = block;
        return;
    }
    uint word = (evenLayerBlock & 0xFFFFu) | block << 16;
    uint place = column * kWordsPerColumn + uint(z) / 2u;
#if TARGET_BLOCKS < 0
    resultBlocks[gl_WorkGroupID.x * kBlocksPerLayer * kWordsPerColumn + place] = word;
#else
    blocks[(slot * BLOCK_PASS_COUNT + TARGET_BLOCKS) * kBlocksPerLayer * kWordsPerColumn + place] = word;
#endif
}
