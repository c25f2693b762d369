// Looks through a whole world in PostgreSQL for damage, changing nothing, as it is at one moment. Any thread;
// it runs for as long as reading all of it takes.
#pragma once

#include "terrane/store/save_check.h"
#include "terrane/store_postgres/address.h"

namespace terrane::store_postgres {

// As store::checkSave(). A world whose settings are damaged is a report with that one problem.
[[nodiscard]] base::Result<store::CheckReport> checkDatabase(const Address& address,
                                                             const world::BlockRegistry& blocks);

}  // namespace terrane::store_postgres
