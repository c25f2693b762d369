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

// One chunk of a dispatch. A slot holds a chunk's fields and blocks on the GPU.
struct TileJob {
    ivec4 origin;  // x, y: block of the first column's sample; z: the chunk's slot; w: blocks to the next
                   // column
    uvec4 neighbors[3];  // slots of the 3×3 chunks around, by y then x; the last three are unused
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(TileJob) == 64);
}
#endif
#endif
