// Opens a world in a database: finds out what is there, makes or migrates its tables, takes the locks under
// which several programs share it. Called by the stores on the thread that opens; what is opened is used by
// one thread at a time.
//
// A world is one schema. Its tables are those of a save (docs/file-format.md), and those of workers and
// servers; docs/scale.md tells each.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "terrane/store/block_id_map.h"
#include "terrane/store/metadata.h"
#include "terrane/store/open_world.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::store_postgres {

// What a world had when it was opened.
struct WorldContents {
    bool isNew = false;
    int format = 0;
    std::int64_t newestEdit = 0;  // of the servers' history
    // How often a program had the world for itself, or made it anew, up to this opening; of a world to write.
    std::int64_t openings = 0;
    store::Metadata metadata;
    store::WorldIdentity identity;
    store::BlockIdMap ids;
};

struct WorldConnection {
    Connection connection;  // has the locks
    WorldContents contents;
};

// To write. Made, with its schema, where it is not there and `access` says so; migrated where it is of an
// older format. Errors: NotFound, Busy, Incompatible, Damaged, Refused, Io.
[[nodiscard]] base::Result<WorldConnection> openToWrite(const Address& address,
                                                        const world::BlockRegistry& blocks,
                                                        const store::SaveAccess& access,
                                                        store::WorldSharing sharing);
// Changes nothing, takes no lock.
[[nodiscard]] base::Result<WorldConnection> openToRead(const Address& address,
                                                       const world::BlockRegistry& blocks);

// The metadata alone. NotFound where there is no world.
[[nodiscard]] base::Result<store::Metadata> readDatabaseMetadata(const Address& address);

// WorldContents::openings as of now.
[[nodiscard]] base::Result<std::int64_t> readOpenings(Connection& connection);

// After a connection was lost: a new one with the same locks, to the world that was opened with `contents`.
// Busy where another program has it, Incompatible where one had it for itself or regenerated it meanwhile.
[[nodiscard]] base::Result<Connection> reconnect(const Address& address, store::WorldSharing sharing,
                                                 const WorldContents& contents);

}  // namespace terrane::store_postgres
