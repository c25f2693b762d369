// A server without sockets: bytes of connections come in, bytes for them go out, and time passes in ticks of
// kServerTick. net/server_sockets.h puts it on a network, tests on a wire of their own. On the server's
// thread.
#pragma once

#include <memory>

#include "terrane/net/server_state.h"

namespace terrane::net {

// Ready for players: edits that a crash kept from the world's file are made again. The listener of tiles
// (SessionParts::tileListener) is to call noteTiles() of the same WrittenTiles.
[[nodiscard]] base::Result<std::unique_ptr<ServerState>> openServer(const ServerParts& parts,
                                                                    const ServerSettings& settings,
                                                                    std::shared_ptr<WrittenTiles> tiles);
void noteTiles(WrittenTiles& written, std::span<const world::ChunkPos> tiles);

// A connection. `channel`: its exported keying material. Numbers are never given twice.
void onOpened(ServerState& server, ConnectionId id, Bytes channel, ClientAddress address, Time now);
// One message, as the client sent it: any bytes.
void onMessage(ServerState& server, ConnectionId id, ByteView message, Time now);
// The client said what cannot be a message: it is sent away.
void onNonsense(ServerState& server, ConnectionId id, const std::string& what, Time now);
// The connection is gone.
void onClosed(ServerState& server, ConnectionId id, Time now);

// Once every kServerTick.
void tick(ServerState& server, Time now);

// Sends everybody away and saves. Then what is outgoing is to be sent, and the server ends.
[[nodiscard]] base::Result<void> stop(ServerState& server, const std::string& reason);

}  // namespace terrane::net
