// A disk under SQLite that fails on request: while a FaultyDisk exists, databases are opened through it. It
// forwards everything except syncs to the system's file system; unsynced_writes.h computes what a power
// failure leaves of unsynced writes.
#pragma once

#include <climits>
#include <cstdint>
#include <memory>

struct sqlite3_vfs;

namespace terrane::store {

// SQLite's file operations, as bits.
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

enum class DiskError : std::uint8_t {
    Io,
    Full,   // fails operations that need disk space
    Short,  // reads and writes first do half; nothing fails
};

enum class DiskStop : std::uint8_t {
    Kill,       // the program ends: all writes stay
    PowerLoss,  // unsynced writes are kept, dropped or torn
};

class FaultyDisk {
  public:
    FaultyDisk();
    ~FaultyDisk();  // outlives all databases opened meanwhile
    FaultyDisk(const FaultyDisk&) = delete;
    FaultyDisk& operator=(const FaultyDisk&) = delete;

    // Skips `after` operations of these kinds, then fails `count` of them.
    void fail(unsigned kinds, long after = 0, long count = LONG_MAX, DiskError error = DiskError::Io);
    void work() { fail(0); }
    long failures() const;  // since the last fail()

    // After `after` operations that change files, the next one may be cut short and nothing reaches the files
    // any more: all operations fail until restart(). The remaining state depends on the seed.
    void stopAfter(DiskStop stop, long after, unsigned seed);
    bool hasStopped() const;
    // Call after all databases were closed: the files have the state left by the stop, and everything works.
    void restart();

    // Hash of all operations so far: kinds, offsets and sizes.
    std::uint64_t history() const;
    // Seeds SQLite's random numbers, so that equal operations have equal histories.
    void seedRandomness(unsigned seed);

  private:
    std::unique_ptr<sqlite3_vfs> vfs_;
};

}  // namespace terrane::store
