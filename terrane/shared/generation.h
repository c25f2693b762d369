// Constants and records shared by the host and the generation shaders.
#ifndef TERRANE_SHARED_GENERATION_H
#define TERRANE_SHARED_GENERATION_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Upper limit on rounds of a loop in a generator: no mistake in a generator hangs a GPU.
const int kMaxLoopRounds = 1024;

// Farthest offset that a pass reads from its column, blocks along x and y: into the chunks around its own.
const int kMaxReadOffset = 16;

// Storage buffers of a generator pass
const uint kTileJobsBinding = 0u;
const uint kFieldsBinding = 1u;
const uint kBlocksBinding = 2u;
const uint kResultBinding = 3u;
const uint kNoiseSeedsBinding = 4u;
const uint kHashSeedsBinding = 5u;
const uint kShapesBinding = 6u;  // 3D passes that stamp

// Shapes of a generator (gen/cpu/shape_table.h): a foot names one with 10 bits on the GPU.
const uint kMaxShapes = 1024u;
// Pairs of a block and a rank that shapes have; 0 is no block.
const uint kShapePaletteWords = 256u;
// Pairs of fields from which a pass stamps: a work group keeps the feet of each in 9 KiB.
const uint kMaxStampsInPass = 2u;

// One chunk of a dispatch. A slot holds a chunk's fields on the GPU, another one its blocks. Slots are those
// of the 3×3 chunks around, by y then x: number 4 is the chunk's own, and the last three are unused.
struct TileJob {
    ivec4 origin;  // x, y: block of the first column's sample; w: blocks to the next column
    uvec4 fieldSlots[3];
    uvec4 blockSlots[3];
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(TileJob) == 112);
}
#endif
#endif
