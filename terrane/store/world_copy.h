// Copies a world from one database into another: its chunks row by row, names of blocks and settings, byte
// for byte. A copy that was cut off goes on where it was. What was put aside as damaged stays behind. Any
// thread.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "terrane/store/queued_store.h"

namespace terrane::store {

struct CopyReport {
    std::uint64_t rows = 0, bytes = 0;  // of the world
    std::uint64_t copied = 0;           // rows that were written now
    std::uint64_t damaged = 0;          // left out: no chunks
    std::string firstDamage;
    // Of all rows by key, in both worlds (base::Digest over key, origin and data).
    std::string digest;
};

// Called from time to time; false ends the copy, which can go on later.
using RowsProgress = std::function<bool(std::uint64_t rows)>;

// What a world to copy into is made with.
SaveAccess accessOfCopy(const ReadableRows& from);

// Marks `to`, which was opened with that access, as a copy of `from` that has not ended, and gives the last
// key that it has. Incompatible where it holds a world, but a copy that was begun of this one.
[[nodiscard]] base::Result<std::int64_t> beginCopy(const ReadableRows& from, ChunkRows& to);

// Copies what comes after the key. Rows of both are compared at the end, and copied again where they differ
// because another program plays `from`; an error where they still do after three times. Busy where `progress`
// ended it.
[[nodiscard]] base::Result<CopyReport> copyWorld(ReadableRows& from, ChunkRows& to, std::int64_t lastKey,
                                                 const RowsProgress& progress = {});

// Metadata of a copy: "unfinished KEY" with the last key that it has, then "finished".
inline constexpr std::string_view kCopyMark = "copy", kUnfinishedCopy = "unfinished ";

}  // namespace terrane::store
