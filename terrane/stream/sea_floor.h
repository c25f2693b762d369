// Simplifies the ground under deep water of tiles. Any thread.
#pragma once

#include "terrane/world/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::stream {

// The depth of water in blocks that hides the ground: the light of far tiles is gone after 15
// (render/water.glsl), and hardly a twentieth of its own color is left.
constexpr int kDeepestSeen = 24;

// Raises ground that lies deeper than that under a liquid to that depth, with one kind of block: in tiles
// with a quarter of sea that saves most quads, which nobody sees.
void raiseDeepFloor(world::Chunk& tile, const world::BlockRegistry& blocks);

}  // namespace terrane::stream
