// From format 2 to format 3: checksums of chunks that cover key and origin, and one over settings and block
// names. A step of schema.cpp.
#pragma once

#include "terrane/store/sqlite.h"

namespace terrane::store {

// In a transaction of the caller. One row at a time is in memory. Rows that are damaged stay as they are.
[[nodiscard]] base::Result<void> addChecksums(Database& database);

}  // namespace terrane::store
