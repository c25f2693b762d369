// A world in a PostgreSQL database, which several programs may share (WorldSharing). docs/scale.md describes
// setup and costs.
#pragma once

#include <memory>

#include "terrane/store/queued_store.h"
#include "terrane/store/saves/save_check.h"
#include "terrane/store_postgres/address.h"
#include "terrane/store_postgres/connection.h"
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

// Checks a whole world in PostgreSQL for damage, as of one moment, without changing it. Any thread; takes as
// long as reading all of it.
// See store::checkSave(). If the settings are damaged, the report only has that problem.
[[nodiscard]] base::Result<store::CheckReport> checkDatabase(const Address& address,
                                                             const world::BlockRegistry& blocks);

}  // namespace terrane::store_postgres
