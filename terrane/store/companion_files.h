// The files beside a save: SQLite's log, its index and its journal, and the lock of this program. Like the
// save they may come from anybody, so they are looked at before anything opens them. Called while a save is
// opened; any thread.
#pragma once

#include <filesystem>

#include "terrane/base/result.h"

namespace terrane::store {

// The save's path without symbolic links, so that its lock and its log are the same for all who open it; what
// is not there yet has its folder's. An error where hard links give the save several names.
[[nodiscard]] base::Result<std::filesystem::path> ownPath(const std::filesystem::path& path);

// Committed transactions that have not reached the file itself: a program was killed, or is writing.
bool hasLog(const std::filesystem::path& path);
// What a transaction that was cut short has to be undone with. Only making a save leaves one.
bool hasJournal(const std::filesystem::path& path);

// A program that had written was killed, which leaves its lock and its log, but the log is gone.
bool hasLostLog(const std::filesystem::path& path);

// An error where one of them is a link or no ordinary file, and where the journal names another file: SQLite
// would delete that one.
[[nodiscard]] base::Result<void> checkCompanions(const std::filesystem::path& path);

}  // namespace terrane::store
