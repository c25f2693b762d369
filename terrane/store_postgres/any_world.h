// Opens, checks and copies worlds at any location, files and databases. A build without libpq supports only
// files and returns Unsupported for URLs. Any thread.
#pragma once

#include <memory>

#include "terrane/store/queued_store.h"
#include "terrane/store/saves/open_world.h"
#include "terrane/store/saves/save_check.h"

namespace terrane::store_postgres {

// A location for messages: a URL without user and password.
std::string shownOf(const store::WorldLocation& location);

// See store::openWorld(), which it calls for names and files.
[[nodiscard]] base::Result<std::unique_ptr<store::ChunkStore>> openAnyWorld(
    const store::WorldLocation& location, const world::BlockRegistry& blocks,
    const store::WorldRequest& request);

// See store::checkSave(). In a database only the tables are checked, not PostgreSQL's files.
[[nodiscard]] base::Result<store::CheckReport> checkAnyWorld(const store::WorldLocation& location,
                                                             const world::BlockRegistry& blocks);

// The metadata of an existing world. Errors as opening it for reading.
[[nodiscard]] base::Result<store::Metadata> anyWorldMetadata(const store::WorldLocation& location);

// The rows of a world, for a copy (store/saves/world_copy.h).
[[nodiscard]] base::Result<std::unique_ptr<store::ReadableRows>> openAnyRowsToRead(
    const store::WorldLocation& location, const world::BlockRegistry& blocks);
[[nodiscard]] base::Result<std::unique_ptr<store::ChunkRows>> openAnyRows(
    const store::WorldLocation& location, const world::BlockRegistry& blocks,
    const store::SaveAccess& access);

}  // namespace terrane::store_postgres
