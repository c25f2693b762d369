// Copies a world from one database into another: its chunks row by row, block names and settings, byte for
// byte. An interrupted copy can be resumed. Quarantined rows are not copied. Any thread may use it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "terrane/store/queued_store.h"

namespace terrane::store {

struct CopyReport {
    std::uint64_t rows = 0, bytes = 0;  // rows and data bytes of the world
    std::uint64_t copied = 0;           // rows written by this call
    std::uint64_t damaged = 0;          // rows left out because they are not valid chunks
    std::string firstDamage;
    // Digest of all rows by key, equal in both worlds (base::Digest over key, origin and data).
    std::string digest;
};

// Called from time to time; false stops the copy, which can be resumed later.
using RowsProgress = std::function<bool(std::uint64_t rows)>;

// Returns the access that creates the target world.
SaveAccess accessOfCopy(const ReadableRows& from);

// Marks `to`, which was opened with that access, as an unfinished copy of `from`, and returns the last key
// that it has. Returns Incompatible if it holds anything but an unfinished copy of this world.
[[nodiscard]] base::Result<std::int64_t> beginCopy(const ReadableRows& from, ChunkRows& to);

// Copies the rows after the key. At the end all rows are compared, and copied again if they differ because
// another program plays `from`; fails if they still differ after three comparisons. Returns Busy if
// `progress` stopped it.
[[nodiscard]] base::Result<CopyReport> copyWorld(ReadableRows& from, ChunkRows& to, std::int64_t lastKey,
                                                 const RowsProgress& progress = {});

// Metadata of a copy: "unfinished KEY" with its last key, then "finished".
inline constexpr std::string_view kCopyMark = "copy", kUnfinishedCopy = "unfinished ";

}  // namespace terrane::store
