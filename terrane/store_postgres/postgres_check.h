// Checks a whole world in PostgreSQL for damage, as of one moment, without changing it. Any thread; takes as
// long as reading all of it.
#pragma once

#include "terrane/store/save_check.h"
#include "terrane/store_postgres/address.h"

namespace terrane::store_postgres {

// See store::checkSave(). If the settings are damaged, the report only has that problem.
[[nodiscard]] base::Result<store::CheckReport> checkDatabase(const Address& address,
                                                             const world::BlockRegistry& blocks);

}  // namespace terrane::store_postgres
