// Worlds at any location, files and databases: what programs open, check and copy them by. A build without
// libpq knows files alone, and gives Unsupported for URLs. Any thread.
#pragma once

#include <memory>

#include "terrane/store/open_world.h"
#include "terrane/store/queued_store.h"
#include "terrane/store/save_check.h"

namespace terrane::store_postgres {

// A location for messages: of a URL neither user nor password.
std::string shownOf(const store::WorldLocation& location);

// As store::openWorld(), which it calls for names and files.
[[nodiscard]] base::Result<std::unique_ptr<store::ChunkStore>> openAnyWorld(
    const store::WorldLocation& location, const world::BlockRegistry& blocks,
    const store::WorldRequest& request);

// As store::checkSave(). Of a database the tables alone are looked at: its own files are PostgreSQL's.
[[nodiscard]] base::Result<store::CheckReport> checkAnyWorld(const store::WorldLocation& location,
                                                             const world::BlockRegistry& blocks);

// The metadata of a world that is there. Errors as opening it to read gives them.
[[nodiscard]] base::Result<store::Metadata> anyWorldMetadata(const store::WorldLocation& location);

// The rows of a world, for a copy (store/world_copy.h).
[[nodiscard]] base::Result<std::unique_ptr<store::ReadableRows>> openAnyRowsToRead(
    const store::WorldLocation& location, const world::BlockRegistry& blocks);
[[nodiscard]] base::Result<std::unique_ptr<store::ChunkRows>> openAnyRows(
    const store::WorldLocation& location, const world::BlockRegistry& blocks,
    const store::SaveAccess& access);

}  // namespace terrane::store_postgres
