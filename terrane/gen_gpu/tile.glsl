// Inputs and outputs of an emitted pass: its column, fields, blocks, seeds. One work group is a chunk's 16×16 columns;
// the second dimension of the dispatch splits the layers of a 3D pass.
//
// Defined by the host: BOTTOM and TOP (the world's heights), FIELD_COUNT, BLOCK_PASS_COUNT (3D passes whose blocks are
// kept), SOURCE_BLOCKS (which of them this pass reads), TARGET_BLOCKS (which it writes; -1: the result of the generator),
// LAYERS_PER_GROUP.
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
    uint resultBlocks[];  // by job, section, column, two layers a word
};
layout(std430, binding = kNoiseSeedsBinding) readonly buffer NoiseSeeds {
    uint noiseSeeds[];
};
layout(std430, binding = kHashSeedsBinding) readonly buffer HashSeeds {
    uint hashSeeds[];
};

const uint kWordsPerColumn = uint(TOP - BOTTOM) / 2u;
const uint kWordsPerSectionColumn = kSectionSize / 2u;
const uint kOwn = 4u;  // the chunk itself among the nine

int columnX, columnY;
uint column;  // in the tile: x + 16 y
uint fieldSlot, blockSlot;
uint evenLayerBlock;  // waits for its odd neighbor

void beginTile() {
    TileJob job = jobs[gl_WorkGroupID.x];
    column = gl_LocalInvocationID.x + kChunkSize * gl_LocalInvocationID.y;
    columnX = job.origin.x + int(gl_LocalInvocationID.x) * job.origin.w;
    columnY = job.origin.y + int(gl_LocalInvocationID.y) * job.origin.w;
    fieldSlot = job.fieldSlots[kOwn >> 2][kOwn & 3u];
    blockSlot = job.blockSlots[kOwn >> 2][kOwn & 3u];
}

int firstLayer() {
    return BOTTOM + int(gl_WorkGroupID.y) * LAYERS_PER_GROUP;
}

// The layer above the group's highest one.
int lastLayer() {
    return min(firstLayer() + LAYERS_PER_GROUP, TOP);
}

uint readField(uint field) {
    return fields[(fieldSlot * FIELD_COUNT + field) * kBlocksPerLayer + column];
}

void writeField(uint field, uint bits) {
    fields[(fieldSlot * FIELD_COUNT + field) * kBlocksPerLayer + column] = bits;
}

// A column of one of the nine chunks. Offsets beyond kMaxReadOffset are clamped, as on the CPU.
struct Place {
    uint neighbor, column;
};

Place placeAt(int dx, int dy) {
    uint x = gl_LocalInvocationID.x + kChunkSize + uint(clamp(dx, -kMaxReadOffset, kMaxReadOffset));
    uint y = gl_LocalInvocationID.y + kChunkSize + uint(clamp(dy, -kMaxReadOffset, kMaxReadOffset));
    uint neighbor = y / kChunkSize * 3u + x / kChunkSize;
    return Place(neighbor, x % kChunkSize + kChunkSize * (y % kChunkSize));
}

uint readFieldAt(uint field, int dx, int dy) {
    Place place = placeAt(dx, dy);
    uint from = jobs[gl_WorkGroupID.x].fieldSlots[place.neighbor >> 2][place.neighbor & 3u];
    return fields[(from * FIELD_COUNT + field) * kBlocksPerLayer + place.column];
}

int readBlock(uint from, uint fromColumn, int z) {
    uint layer = uint(clamp(z, BOTTOM, TOP - 1) - BOTTOM);
    uint columns = (from * BLOCK_PASS_COUNT + SOURCE_BLOCKS) * kBlocksPerLayer + fromColumn;
    uint word = blocks[columns * kWordsPerColumn + layer / 2u];
    return int((layer & 1u) == 0u ? word & 0xFFFFu : word >> 16);
}

int blockInColumn(int z) {
    return readBlock(blockSlot, column, z);
}

int blockAt(int dx, int dy, int z) {
    Place place = placeAt(dx, dy);
    return readBlock(jobs[gl_WorkGroupID.x].blockSlots[place.neighbor >> 2][place.neighbor & 3u], place.column, z);
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
    uint layer = uint(z - BOTTOM);
#if TARGET_BLOCKS < 0
    uint section = gl_WorkGroupID.x * (uint(TOP - BOTTOM) / kSectionSize) + layer / kSectionSize;
    resultBlocks[(section * kBlocksPerLayer + column) * kWordsPerSectionColumn + layer % kSectionSize / 2u] = word;
#else
    uint columns = (blockSlot * BLOCK_PASS_COUNT + TARGET_BLOCKS) * kBlocksPerLayer + column;
    blocks[columns * kWordsPerColumn + layer / 2u] = word;
#endif
}
