// Opens the file of a save: validates it, takes the lock, creates or migrates the tables. Called by the
// stores and by save_check.cpp, on the thread that opens the save; the result is used by one thread at a
// time.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "terrane/base/result.h"
#include "terrane/store/chunks/block_id_map.h"
#include "terrane/store/saves/file_lock.h"
#include "terrane/store/sqlite/schema.h"
#include "terrane/store/sqlite/sqlite.h"

namespace terrane::store {

// The files beside a save: SQLite's log, index and journal, and this program's lock. Like the save they are
// untrusted, so they are checked before anything opens them. Called while a save is opened; any thread.
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

struct SaveFile {
    std::optional<FileLock> lock;  // no value while another program writes; destroyed last
    Database database;
    OpenMode readers = OpenMode::ReadOnly;  // mode of further connections
    bool isNew = false;
    // The program that writes the save meanwhile: "open in another program (process 12)"; empty: none can.
    std::string inUse = {};

    // Contents when the save was opened.
    std::int64_t format = kFormatVersion;  // older only if opened for reading
    Metadata metadata = {};
    WorldIdentity identity = {};
    BlockIdMap ids = {};
};

// Opens for reading and writing. Names of new block types are already written.
[[nodiscard]] base::Result<SaveFile> openToWrite(const std::filesystem::path& path,
                                                 const world::BlockRegistry& registry,
                                                 const SaveAccess& access);

// Opens for reading; changes nothing. A save that another program writes is read as of one moment, including
// its log; otherwise it stays locked against writers. A transaction of the connection has begun, for further
// reads of that moment: COMMIT ends it. Busy if the other program is creating or migrating the save.
[[nodiscard]] base::Result<SaveFile> openToRead(const std::filesystem::path& path,
                                                const world::BlockRegistry& registry);

// Reads only the metadata. Errors as openToRead().
[[nodiscard]] base::Result<Metadata> readSavedMetadata(const std::filesystem::path& path);

}  // namespace terrane::store
