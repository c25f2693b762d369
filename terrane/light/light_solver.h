// Light levels of an area of chunks, from scratch.
//
// Each voxel has four levels 0…15: red, green, blue, daylight. The result is the least fixed point of
//   v = max(source, n₀ − d, …, n₅ − d) over the six neighbours, d = 1 + opacity of v, for each component,
// where the source of a colour is the block's emission, and of daylight 15 less the opacities of the blocks
// from the top of the world down to v (nothing is lost with distance straight down). Any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "terrane/world/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::light {

// Light reaches at most 15 blocks, so that levels are exact one chunk inside the area given.
struct LightArea {
    int chunksX = 0, chunksY = 0;
    std::vector<const world::Chunk*> chunks;  // chunksX × chunksY, x fastest
};

// Red in bits 0–3, green 4–7, blue 8–11, daylight 12–15.
using LightValue = std::uint16_t;

// Levels of all blocks: index x + width·(y + height·z) with width = 16 chunksX, height = 16 chunksY in
// blocks. Takes 3 bytes a block while it runs (192 KiB a chunk).
std::vector<LightValue> solveLight(const LightArea& area, const world::BlockRegistry& blocks);

}  // namespace terrane::light
