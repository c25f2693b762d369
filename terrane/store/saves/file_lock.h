// Locks a save against other programs. The lock is a file beside it, removed at the end; a killed program
// leaves the file but not the lock. The file holds the program's process id and, if the save's last
// transactions may only be in the log, the word "log", which readers do not change. The save itself is not
// locked: closing any handle of a file would release SQLite's locks on it.
//
// Any thread may acquire one; a lock is used by one thread at a time.
#pragma once

#include <filesystem>
#include <utility>

#include "terrane/base/result.h"

namespace terrane::store {

inline constexpr const char* kLogWord = "log";

class FileLock {
  public:
    enum class Kind { Exclusive, Shared };

    // Does not wait. The error names `path` and the program that holds the lock. A shared lock needs no write
    // permission. If its file is missing and cannot be created, no program is writing: the returned object
    // locks nothing and does not block later programs.
    [[nodiscard]] static base::Result<FileLock> acquire(const std::filesystem::path& path, Kind kind);
    ~FileLock();
    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;

    // Notes in the lock's file whether the save has a log; durable on return. For an exclusive lock.
    void setHasLog(bool hasLog);

  private:
    FileLock(int descriptor, Kind kind, std::filesystem::path file)
        : descriptor_(descriptor), kind_(kind), file_(std::move(file)) {}
    void release();

    int descriptor_ = -1;
    Kind kind_ = Kind::Shared;
    bool hasLog_ = false;
    std::filesystem::path file_;
};

}  // namespace terrane::store
