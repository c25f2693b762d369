// What clients are told of the world: how edited chunks in view, and edited tiles beyond them, differ from
// the generator's, the nearest first, then each change. On the server's thread.
#pragma once

#include "terrane/net/server_state.h"

namespace terrane::net {

// A tile is told where it is so many of its widths away (Chebyshev): nearer ones are never shown
// (docs/levels.md), and with the finest detail none is farther away.
constexpr int kNearestTile = 3, kFarthestTile = 33;

// Blocks that changed since the last tick, to all in whose view they are. In each tick.
void tellChangedBlocks(ServerState& server);
// Blocks of one chunk, which need not be loaded, to all in whose view they are.
void tellBlocks(ServerState& server, world::ChunkPos chunk, const ChunkDifference& blocks);
// Tiles of the store changed: their clients are told in a later tick.
void onTilesChanged(ServerState& server, std::span<const world::ChunkPos> tiles);
// Looks where clients ask to, and tells what they lack of their views as fast as they read. In each tick,
// after tellChangedBlocks().
void tellViews(ServerState& server);

}  // namespace terrane::net
