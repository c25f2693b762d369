// A server without sockets: takes bytes of connections, produces bytes for them, and advances in ticks of
// kServerTick. net/server_sockets.h connects it to a network, tests to a simulated one. On the server's
// thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Opens a server that is ready for players; edits that a crash kept out of the world's store are applied
// again.
[[nodiscard]] base::Result<std::unique_ptr<ServerState>> openServer(const ServerParts& parts,
                                                                    const ServerSettings& settings);

// A new connection. `channel`: its exported keying material. Ids are never reused.
void onOpened(ServerState& server, ConnectionId id, Bytes channel, ClientAddress address, Time now);
// One message of a client; may be any bytes.
void onMessage(ServerState& server, ConnectionId id, ByteView message, Time now);
// The client sent bytes that cannot be a message: it is disconnected.
void onMalformedMessage(ServerState& server, ConnectionId id, const std::string& what, Time now);
// The connection was closed.
void onClosed(ServerState& server, ConnectionId id, Time now);

// Call once every kServerTick.
void tick(ServerState& server, Time now);

// For statistics.
struct ServerCounts {
    std::size_t players = 0, loadedChunks = 0, editedChunks = 0;
    std::int64_t edits = 0;  // number of the world's newest edit, across all its servers
};
ServerCounts countsOf(const ServerState& server);

// Finishes rollbacks and saves all changes to the store and the records. Blocks.
[[nodiscard]] base::Result<void> saveEverything(ServerState& server);
// Disconnects all players and saves. Afterwards the caller sends the outgoing bytes and ends the server.
[[nodiscard]] base::Result<void> stop(ServerState& server, const std::string& reason);

}  // namespace terrane::net
