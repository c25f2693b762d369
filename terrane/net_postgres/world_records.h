// Opens the records of a served world: a file beside the world, or the same database.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "terrane/net/server/edit_log.h"
#include "terrane/net/server/server_records.h"
#include "terrane/store/saves/save_path.h"

namespace terrane::net_postgres {

struct WorldRecords {
    std::unique_ptr<net::ServerRecords> records;
    // Publishes this server's address and key to other servers of the world, and through them to players.
    // Empty for a world in a file.
    std::function<void(const std::string& address, const std::string& key)> publishAddress;
};

// The records of an open world. Errors name the file or the database.
[[nodiscard]] base::Result<WorldRecords> openRecords(const store::WorldLocation& world,
                                                     const world::BlockRegistry& blocks);
// Opens the records to read them. Does not write to a database, which may be a replica.
[[nodiscard]] base::Result<std::unique_ptr<net::ServerRecords>> openRecordsToRead(
    const store::WorldLocation& world, const world::BlockRegistry& blocks);

// The history of edits, without a running server.
[[nodiscard]] base::Result<net::History> openHistory(const store::WorldLocation& world,
                                                     const world::BlockRegistry& blocks);
// Writes a world in a database as new files: the world and, if servers have run it, the server's file beside
// it. Both have one moment, also while servers run. The chunks may lack edits at the end of the history,
// which a server adds that opens the files. Any thread.
[[nodiscard]] base::Result<void> copyDatabase(const store::WorldLocation& world,
                                              const world::BlockRegistry& blocks,
                                              const std::filesystem::path& save,
                                              const store::CopyProgress& progress);

// Whether the world may have records of servers: the file exists, or the world is in a database.
[[nodiscard]] bool hasRecords(const store::WorldLocation& world);

// The base path of a server's own files: "a/home" for a/home.sqlite; for a world in a database a path in the
// data folder that ends with the server's port. Callers append ".server.pem" and the like.
[[nodiscard]] base::Result<std::filesystem::path> serverFilesOf(const store::WorldLocation& world,
                                                                std::uint16_t port);

}  // namespace terrane::net_postgres
