// Opens a world in a database: checks it, creates or migrates its tables, takes the locks under which
// programs share it. Called by the stores on the thread that opens; the result is used by one thread at a
// time.
//
// A world is one schema. Its tables are those of a save (docs/file-format.md), and those of workers and
// servers; docs/scale.md describes each.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "terrane/store/chunks/block_id_map.h"
#include "terrane/store/saves/open_world.h"
#include "terrane/store/saves/world_identity.h"
#include "terrane/store_postgres/connection.h"

namespace terrane::store_postgres {

// Contents of a world when it was opened.
struct WorldContents {
    bool isNew = false;
    int format = 0;
    std::int64_t newestEdit = 0;  // newest edit of the servers' history
    // Number of exclusive openings and regenerations up to this opening; for a world opened for writing.
    std::int64_t openings = 0;
    store::Metadata metadata;
    store::WorldIdentity identity;
    store::BlockIdMap ids;
};

struct WorldConnection {
    Connection connection;  // has the locks
    WorldContents contents;
};

// Opens for writing. Creates the world and its schema if missing and `access` requests it; migrates older
// formats. Errors: NotFound, Busy, Incompatible, Damaged, Refused, Io.
[[nodiscard]] base::Result<WorldConnection> openToWrite(const Address& address,
                                                        const world::BlockRegistry& blocks,
                                                        const store::SaveAccess& access,
                                                        store::WorldSharing sharing);
// What a reader sees of a world that others write.
enum class ReadAs {
    Statements,  // each statement sees what is committed when it begins
    Snapshot,    // all see one moment, the block names included
};

// Opens for reading; changes nothing, takes no lock.
[[nodiscard]] base::Result<WorldConnection> openToRead(const Address& address,
                                                       const world::BlockRegistry& blocks,
                                                       ReadAs readAs = ReadAs::Statements);

// Reads only the metadata. NotFound if there is no world.
[[nodiscard]] base::Result<store::Metadata> readDatabaseMetadata(const Address& address);

// The current WorldContents::openings.
[[nodiscard]] base::Result<std::int64_t> readOpenings(Connection& connection);

// Replaces a lost connection by a new one with the same locks, to the world that was opened with `contents`.
// Busy if another program has the world, Incompatible if one had it exclusively or regenerated it meanwhile.
[[nodiscard]] base::Result<Connection> reconnect(const Address& address, store::WorldSharing sharing,
                                                 const WorldContents& contents);

}  // namespace terrane::store_postgres
