// A disk that fails when a test says so, under SQLite: while a FaultyDisk lives, databases are opened through
// it. It passes everything on to the system's own file system, but for syncs: what a power loss leaves of
// writes without one is computed by unsynced_writes.h.
#pragma once

#include <climits>
#include <cstdint>
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

enum class DiskError : std::uint8_t {
    Io,
    Full,   // of what needs room
    Short,  // reads and writes do half of it at first; nothing fails
};

enum class DiskStop : std::uint8_t {
    Kill,       // the program ends: all that was written stays
    PowerLoss,  // unsynced writes are kept, dropped or torn
};

class FaultyDisk {
  public:
    FaultyDisk();
    ~FaultyDisk();  // after all databases that were opened meanwhile
    FaultyDisk(const FaultyDisk&) = delete;
    FaultyDisk& operator=(const FaultyDisk&) = delete;

    // From the next operation of these kinds on `count` of them fail, after `after` that do not.
    void fail(unsigned kinds, long after = 0, long count = LONG_MAX, DiskError error = DiskError::Io);
    void work() { fail(0); }
    long failures() const;  // since the last fail()

    // After `after` operations that change files the next one may be cut short, and nothing reaches the files
    // any more: all operations fail until restart(). What is left depends on the seed.
    void stopAfter(DiskStop stop, long after, unsigned seed);
    bool hasStopped() const;
    // After all databases were closed: the files are what the stop left, and everything works.
    void restart();

    // Of all operations so far: their kinds, offsets and sizes.
    std::uint64_t history() const;
    // What SQLite's random numbers begin with, so that the same operations have the same history.
    void seedRandomness(unsigned seed);

  private:
    std::unique_ptr<sqlite3_vfs> vfs_;
};

}  // namespace terrane::store
