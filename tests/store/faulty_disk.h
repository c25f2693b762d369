// A disk that fails when a test says so, under SQLite: while a FaultyDisk lives, databases are opened through
// it. It passes everything on to the system's own file system.
#pragma once

#include <climits>
#include <memory>

struct sqlite3_vfs;

namespace terrane::store {

// What SQLite asks of files; a set of bits.
enum DiskOperation : unsigned {
    kDiskOpen = 1,
    kDiskRead = 2,
    kDiskWrite = 4,
    kDiskTruncate = 8,
    kDiskSync = 16,
    kDiskLock = 32,
    kDiskMap = 64,  // shared memory of the log's index
    kDiskDelete = 128,
    kDiskAny = 255,
};

class FaultyDisk {
  public:
    FaultyDisk();
    ~FaultyDisk();  // after all databases that were opened meanwhile
    FaultyDisk(const FaultyDisk&) = delete;
    FaultyDisk& operator=(const FaultyDisk&) = delete;

    // From the next operation of these kinds on `count` of them fail, after `after` that do not.
    void fail(unsigned kinds, long after = 0, long count = LONG_MAX);
    void work() { fail(0); }
    long operations() const;  // of the kinds of the last fail(), since then

  private:
    std::unique_ptr<sqlite3_vfs> vfs_;
};

}  // namespace terrane::store
