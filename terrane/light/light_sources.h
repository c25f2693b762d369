// Light sources of a chunk from its own blocks, before light spreads: opacities, emission and the daylight of
// its columns. Part of LocalLight (light_chunk.h); any thread.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "terrane/light/brick.h"
#include "terrane/light/light_table.h"
#include "terrane/world/chunk.h"

namespace terrane::light {

// Sixteen bricks of a chunk. The function that fills it states who owns the values.
struct ChunkBricks {
    std::array<BrickView, world::kSectionsPerChunk> light, opacity;
};

// Fills bricks from number `lowest` on; those below stay empty. The pool owns the bricks that are not shared.
ChunkBricks findSources(const world::Chunk& chunk, const LightTable& table, BrickPool& pool, int lowest = 0);

}  // namespace terrane::light
