// Opens the world at a location, a file or a database, with the store that fits: what programs call. Any
// thread, usually the one that starts a session.
#pragma once

#include <memory>

#include "terrane/store/open_world.h"

namespace terrane::store_postgres {

// As store::openWorld(), which it calls for names and files. Unsupported for a URL of another kind, and for
// any in a build without libpq.
[[nodiscard]] base::Result<std::unique_ptr<store::ChunkStore>> openAnyWorld(
    const store::WorldLocation& location, const world::BlockRegistry& blocks,
    const store::WorldRequest& request);

}  // namespace terrane::store_postgres
