// In a build without libpq.
#include "terrane/store_postgres/open_any_world.h"

namespace terrane::store_postgres {

base::Result<std::unique_ptr<store::ChunkStore>> openAnyWorld(const store::WorldLocation& location,
                                                              const world::BlockRegistry& blocks,
                                                              const store::WorldRequest& request) {
    return store::openWorld(location, blocks, request);
}

}  // namespace terrane::store_postgres
