// Keeps other programs from a save. The lock is a file beside it, removed at the end; a program that is
// killed leaves the file but not the lock. The file holds the program's process number and, where the save's
// last transactions may be in the log alone, the word "log", which readers leave there. Not a lock on the
// save itself: closing any handle of a file would end the locks that SQLite has on it.
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

    // Does not wait. The error names `path`, what is locked, and the program that has it. A shared lock needs
    // no right to write. Where its file is missing and cannot be made, nobody writes now: what is returned
    // locks nothing, and does not keep out who comes later.
    [[nodiscard]] static base::Result<FileLock> acquire(const std::filesystem::path& path, Kind kind);
    ~FileLock();
    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;

    // Notes in the lock's file that a log belongs to the save, or none any more: that is on the disk when
    // this returns. Of an exclusive lock.
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
