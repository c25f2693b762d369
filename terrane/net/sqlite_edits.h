// The history in the file of a server, for its server and for who reads it besides.
#pragma once

#include "terrane/net/edit_log.h"
#include "terrane/store/sqlite.h"

namespace terrane::net {

// As ServerRecords::forEachEdit().
[[nodiscard]] base::Result<void> forEachEdit(store::Database& database, const store::BlockIdMap& ids,
                                             const EditFilter& filter, EditOrder order, const UseEdit& use);

}  // namespace terrane::net
