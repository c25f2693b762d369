// Sends the world's edits to clients: first the differences of edited chunks in view and of edited tiles
// beyond, nearest first, then each change. On the server's thread.
#pragma once

#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Sends the values that changed blocks have now to the clients that have their chunks in view.
void sendChangedBlocks(ServerClients& clients, ServerEdits& edits, const world::World& world,
                       ChangedIndices changed);
// Sends blocks of one chunk, which need not be loaded, to the clients that have it in view.
void sendBlocks(ServerClients& clients, ServerEdits& edits, world::ChunkPos chunk,
                const ChunkDifference& blocks);
// Notes changed tiles of the store; clients are told in a later tick.
void onTilesChanged(ServerEdits& edits, std::span<const world::ChunkPos> tiles);
// Updates the views of clients, and sends missing differences as fast as each client reads. Call in each
// tick, after sendChangedBlocks().
void sendViews(ServerClients& clients, ServerEdits& edits);

}  // namespace terrane::net
