// Upgrades format 2 to format 3: checksums of chunks that cover key and origin, and a checksum over settings
// and block names. A step of schema.cpp.
#pragma once

#include "terrane/store/sqlite.h"

namespace terrane::store {

// Runs in the caller's transaction, with one row at a time in memory. Damaged rows stay as they are.
[[nodiscard]] base::Result<void> addChecksums(Database& database);

}  // namespace terrane::store
