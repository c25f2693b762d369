// The servers of a world, where their players are, and which of them lets time pass where: rows in
// PostgreSQL. For the thread that writes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "terrane/net/shared_world.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::net_postgres {

// A server that was not heard of for so long is gone.
constexpr int kGoneSeconds = 8;

struct ServerName {
    std::string name, address, key;
};

// The new server's number; it has nothing to save.
[[nodiscard]] base::Result<std::int64_t> addServer(store_postgres::Connection& connection,
                                                   const ServerName& name);
// Its row, its players and leases go, at its end. `saved`: up to this edit it has nothing to save.
[[nodiscard]] base::Result<void> removeServer(store_postgres::Connection& connection, std::int64_t server,
                                              std::int64_t saved);

// The same of another server, unless it is heard of again.
store_postgres::Command forgetServerCommand(std::int64_t server);

struct ServerBeat {
    std::int64_t server = 0, saved = 0;
    int players = 0;
    std::vector<net::Region> regions;  // that it wants to let time pass in
};
struct BeatAnswer {
    std::int64_t saved = 0;  // of all servers
    std::vector<net::OtherServer> others;
    std::vector<net::Region> regions;  // that it has for kGoneSeconds
};
// Says that the server is there, and looks what others are.
[[nodiscard]] base::Result<BeatAnswer> beat(store_postgres::Connection& connection, const ServerName& name,
                                            const ServerBeat& state);

// Chunks whose edits are in the history alone.
[[nodiscard]] base::Result<std::vector<world::ChunkPos>> unsavedChunks(store_postgres::Connection& connection,
                                                                       std::int64_t server);

}  // namespace terrane::net_postgres
