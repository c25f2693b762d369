// Opens the file of a save: validates it, takes the lock, creates or migrates the tables. It is called by the
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

// Returns whether a file or a link, also a broken one, exists. The files beside a save are SQLite's log,
// index and journal, and this program's lock. Like the save they are untrusted, so they are checked before
// anything opens them.
bool isPresent(const std::filesystem::path& path);
// Returns the path of a file beside a save: NAME.sqlite-wal for NAME.sqlite and "-wal".
std::filesystem::path companionPath(const std::filesystem::path& save, const char* ending);

// Returns the save's path without symbolic links, so that all programs use the same lock and log; for a
// missing file, its folder is resolved. Fails if hard links give the save several names.
[[nodiscard]] base::Result<std::filesystem::path> resolvedPath(const std::filesystem::path& path);

// Returns whether the log has committed transactions that are not in the file itself: a program was killed or
// is writing.
bool hasLog(const std::filesystem::path& path);
// Returns whether a journal to undo an interrupted transaction exists. Only creating a save leaves one.
bool hasJournal(const std::filesystem::path& path);

// Returns the reason why changes are lost if a writing program was killed, leaving its lock and log, and the
// log is now missing, in one line, or empty if no log is lost. Acquiring the lock to write removes the note
// of it.
std::string lostLog(const std::filesystem::path& path);

// Fails if a file beside the save is a link or not a regular file, or if the journal names another file,
// which SQLite would delete.
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
// reads of that moment: COMMIT ends it. Returns Busy if the other program is creating or migrating the save.
[[nodiscard]] base::Result<SaveFile> openToRead(const std::filesystem::path& path,
                                                const world::BlockRegistry& registry);

// Reads only the metadata. Errors are those of openToRead().
[[nodiscard]] base::Result<Metadata> readSavedMetadata(const std::filesystem::path& path);

}  // namespace terrane::store
