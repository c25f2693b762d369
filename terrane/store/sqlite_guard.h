// What a connection to SQLite may do with a file that anybody may have made: a save cannot bring code of its
// own (triggers, views, functions in its schema), nor values and statements larger than saves have. Used by
// sqlite.cpp.
#pragma once

struct sqlite3;

namespace terrane::store {

// Longer texts and blobs are not read: kMaxChunkBytes (64 MiB) before compression, and what a frame of zstd
// can be larger than its content.
constexpr int kMaxValueBytes = (64 << 20) + (1 << 20);

// Before anything is read.
void guardConnection(sqlite3* database);

// Stops what runs too long while this is alive: SQLite then gives SQLITE_INTERRUPT. For statements whose time
// a broken file decides, such as reading the list of its tables.
class StepLimit {
  public:
    StepLimit(sqlite3* database, int thousands);  // of steps of SQLite's machine, about 0.1 ms each
    ~StepLimit();
    StepLimit(const StepLimit&) = delete;
    StepLimit& operator=(const StepLimit&) = delete;

  private:
    sqlite3* database_;
    int left_;
};

}  // namespace terrane::store
