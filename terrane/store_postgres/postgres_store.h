// A world in a PostgreSQL database, which several programs may share (WorldSharing). docs/scale.md describes
// setup and costs.
#pragma once

#include <memory>

#include "terrane/store/queued_store.h"
#include "terrane/store/rows_reader.h"
#include "terrane/store_postgres/connection_pool.h"
#include "terrane/store_postgres/world_database.h"

namespace terrane::store_postgres {

class PostgresStore : public store::QueuedStore {
  public:
    // See store::SqliteStore::open().
    [[nodiscard]] static base::Result<std::unique_ptr<PostgresStore>> open(
        const Address& address, const world::BlockRegistry& blocks, const store::SaveAccess& access,
        store::WorldSharing sharing = store::WorldSharing::Alone, const store::SaveLimits& limits = {},
        RetryTimes times = {});

  private:
    using QueuedStore::QueuedStore;
};

// Opens a world for reading.
[[nodiscard]] base::Result<std::unique_ptr<store::ReadableStore>> openReader(
    const Address& address, const world::BlockRegistry& blocks, const store::SaveLimits& limits = {},
    RetryTimes times = {});

// Only the rows, for a copy.
[[nodiscard]] base::Result<std::unique_ptr<store::ChunkRows>> openRows(
    const Address& address, const world::BlockRegistry& blocks, const store::SaveAccess& access,
    store::WorldSharing sharing = store::WorldSharing::Alone, RetryTimes times = {});
[[nodiscard]] base::Result<std::unique_ptr<store::ReadableRows>> openRowsToRead(
    const Address& address, const world::BlockRegistry& blocks, RetryTimes times = {});

}  // namespace terrane::store_postgres
