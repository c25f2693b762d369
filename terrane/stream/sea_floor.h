// Simplifies the ground under deep water of tiles. Any thread.
#pragma once

#include "terrane/world/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::stream {

// The depth of water in blocks that hides the ground: on far tiles no light is left after 15
// (render/water.glsl), and the color of the water itself is within a twentieth of that of deep water.
constexpr int kDeepestSeen = 24;

// Raises ground that lies deeper than that under a liquid to that depth, with one kind of block: in tiles
// with a quarter of sea this saves most quads, which are invisible.
void raiseDeepFloor(world::Chunk& tile, const world::BlockRegistry& blocks);

}  // namespace terrane::stream
