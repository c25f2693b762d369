// The files beside a save: SQLite's log, index and journal, and this program's lock. Like the save they are
// untrusted, so they are checked before anything opens them. Called while a save is opened; any thread.
#pragma once

#include <filesystem>
#include <string>

#include "terrane/base/result.h"

namespace terrane::store {

// Also true for a broken link.
bool isPresent(const std::filesystem::path& path);
// NAME.sqlite-wal for NAME.sqlite and "-wal".
std::filesystem::path beside(const std::filesystem::path& save, const char* ending);

// The save's path without symbolic links, so that all programs use the same lock and log; for a missing file,
// its folder is resolved. Fails if hard links give the save several names.
[[nodiscard]] base::Result<std::filesystem::path> ownPath(const std::filesystem::path& path);

// Whether the log has committed transactions that are not in the file itself: a program was killed or is
// writing.
bool hasLog(const std::filesystem::path& path);
// Whether a journal to undo an interrupted transaction exists. Only creating a save leaves one.
bool hasJournal(const std::filesystem::path& path);

// Why changes are lost if a writing program was killed, leaving its lock and log, and the log is now missing,
// one line; empty: no log is lost. Taking the lock to write removes the note of it.
std::string lostLog(const std::filesystem::path& path);

// Fails if one of them is a link or not a regular file, or if the journal names another file, which SQLite
// would delete.
[[nodiscard]] base::Result<void> checkCompanions(const std::filesystem::path& path);

}  // namespace terrane::store
