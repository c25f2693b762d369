// Restricts a SQLite connection to an untrusted file: a save cannot contain code (triggers, views, functions
// in its schema), or values and statements larger than saves have. Used by sqlite.cpp.
#pragma once

struct sqlite3;

namespace terrane::store {

// Longer texts and blobs are not read: kMaxChunkBytes (64 MiB) before compression, plus the overhead of a
// zstd frame.
constexpr int kMaxValueBytes = (64 << 20) + (1 << 20);

// Call before anything is read.
void guardConnection(sqlite3* database);

// Stops statements that take too many steps while this exists: SQLite then returns SQLITE_INTERRUPT. For
// statements whose duration depends on a damaged file, such as reading the list of its tables.
class StepLimit {
  public:
    StepLimit(sqlite3* database, int thousands);  // limit in 1,000 VM steps, which take about 0.1 ms
    ~StepLimit();
    StepLimit(const StepLimit&) = delete;
    StepLimit& operator=(const StepLimit&) = delete;

  private:
    sqlite3* database_;
    int left_;
};

}  // namespace terrane::store
