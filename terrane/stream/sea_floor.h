// The ground under deep water, as tiles show it. Any thread.
#pragma once

#include "terrane/world/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::stream {

// Blocks of water through which no ground is seen: by the light of far tiles none is left after 15
// (render/water.glsl), by its own color hardly a twentieth.
constexpr int kDeepestSeen = 24;

// Raises ground that lies deeper than that under a liquid to that depth, with one kind of block: where a
// quarter of a tile is sea that spares most of its quads, which nobody sees.
void raiseDeepFloor(world::Chunk& tile, const world::BlockRegistry& blocks);

}  // namespace terrane::stream
