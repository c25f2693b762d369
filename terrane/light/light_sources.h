// What of a chunk's light its own blocks tell without spreading: opacities, emission and the daylight of its
// columns. Part of LocalLight (light_chunk.h); any thread.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "terrane/light/brick.h"
#include "terrane/light/light_table.h"
#include "terrane/world/chunk.h"

namespace terrane::light {

// Sixteen bricks of a chunk; who keeps their values is told where one is made.
struct ChunkBricks {
    std::array<BrickView, world::kSectionsPerChunk> light, opacity;
};

// Bricks from number `lowest` on; those below stay empty. The pool keeps what is not shared.
ChunkBricks findSources(const world::Chunk& chunk, const LightTable& table, BrickPool& pool, int lowest = 0);

}  // namespace terrane::light
