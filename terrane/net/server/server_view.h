// Sends the world's edits to clients: first the differences of edited chunks in view and of edited tiles
// beyond, nearest first, then each change. On the server's thread.
#pragma once

#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Sends blocks that changed since the last tick to the clients that have their chunks in view. Call in each
// tick.
void sendChangedBlocks(ServerState& server);
// Sends blocks of one chunk, which need not be loaded, to the clients that have it in view.
void sendBlocks(ServerState& server, world::ChunkPos chunk, const ChunkDifference& blocks);
// Notes changed tiles of the store; clients are told in a later tick.
void onTilesChanged(ServerState& server, std::span<const world::ChunkPos> tiles);
// Updates the views of clients, and sends missing differences as fast as each client reads. Call in each
// tick, after sendChangedBlocks().
void sendViews(ServerState& server);

}  // namespace terrane::net
