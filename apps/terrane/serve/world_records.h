// Where the records of a served world are, by where the world is: a file beside it, or the same database.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "terrane/net/history.h"
#include "terrane/net/server_records.h"
#include "terrane/store/world_location.h"

namespace terrane::app {

struct WorldRecords {
    std::unique_ptr<net::ServerRecords> records;
    // Tells other servers of the world, and players through them, where this one is and its key. May be
    // empty.
    std::function<void(const std::string& address, const std::string& key)> tellAddress;
};

// Of a world that is open. Errors name the file or the database.
[[nodiscard]] base::Result<WorldRecords> openRecords(const store::WorldLocation& world,
                                                     const world::BlockRegistry& blocks);
// To be read alone: a database may be a replica.
[[nodiscard]] base::Result<std::unique_ptr<net::ServerRecords>> openRecordsToRead(
    const store::WorldLocation& world, const world::BlockRegistry& blocks);

// The same without a server: what servers of the world did.
[[nodiscard]] base::Result<net::History> openHistory(const store::WorldLocation& world,
                                                     const world::BlockRegistry& blocks);
// Whether servers of the world left records; false where there is nothing to copy.
[[nodiscard]] bool hasRecords(const store::WorldLocation& world);

// Files that belong to a server and not to its world: "a/home" for a/home.sqlite, and for a world in a
// database a name in the folder of worlds that ends with the server's port. ".server.pem" and the like are
// added to it.
[[nodiscard]] base::Result<std::filesystem::path> serverFilesOf(const store::WorldLocation& world,
                                                                std::uint16_t port);

}  // namespace terrane::app
