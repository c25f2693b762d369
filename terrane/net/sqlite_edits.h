// Reads the edit history in a server's file; for its server and for other readers.
#pragma once

#include "terrane/net/edit_log.h"
#include "terrane/store/sqlite.h"

namespace terrane::net {

// See ServerRecords::forEachEdit().
[[nodiscard]] base::Result<void> forEachEdit(store::Database& database, const store::BlockIdMap& ids,
                                             const EditFilter& filter, EditOrder order, const UseEdit& use);

}  // namespace terrane::net
