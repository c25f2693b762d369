// The servers of a world, their players, and the leases of regions in which a server lets time pass: rows in
// PostgreSQL. For the thread that writes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terrane/net/sharing/shared_world.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::net_postgres {

// A server without a heartbeat for this long is gone.
constexpr int kGoneSeconds = 8;

struct ServerName {
    std::string name, address, key;
};

// Adds a server and returns its number; it has nothing to save.
[[nodiscard]] base::Result<std::int64_t> addServer(store_postgres::Connection& connection,
                                                   const ServerName& name);
// Removes the server's row, players and leases when it ends. `saved`: all its edits up to this one are saved.
[[nodiscard]] base::Result<void> removeServer(store_postgres::Connection& connection, std::int64_t server,
                                              std::int64_t saved);

// The same for another server, unless it has a recent heartbeat.
store_postgres::Command removeServerCommand(std::int64_t server);

struct ServerBeat {
    std::int64_t server = 0, saved = 0;
    int players = 0;
    std::vector<net::Region> regions;  // requested regions
};
struct BeatAnswer {
    std::int64_t saved = 0;  // minimum over all servers
    std::vector<net::OtherServer> others;
    std::vector<net::Region> regions;  // leased for kGoneSeconds
};
// Sends a heartbeat and reads the state of the other servers.
[[nodiscard]] base::Result<BeatAnswer> beat(store_postgres::Connection& connection, const ServerName& name,
                                            const ServerBeat& state);

// Chunks of the server whose edits are only in the history.
[[nodiscard]] base::Result<std::vector<world::ChunkPos>> unsavedChunks(store_postgres::Connection& connection,
                                                                       std::int64_t server);

}  // namespace terrane::net_postgres
