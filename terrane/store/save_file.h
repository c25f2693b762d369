// Opens the file of a save: finds out what is wrong with it before anything is done, takes the lock, makes or
// migrates the tables. Called by the stores and by save_check.cpp, on the thread that opens the save; what is
// opened is used by one thread at a time.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "terrane/store/block_id_map.h"
#include "terrane/store/file_lock.h"
#include "terrane/store/schema.h"
#include "terrane/store/sqlite.h"

namespace terrane::store {

struct SaveFile {
    std::optional<FileLock> lock;  // none while another program writes. Goes last.
    Database database;
    OpenMode readers = OpenMode::ReadOnly;  // how further connections are to be opened
    bool isNew = false;
    // Who writes it meanwhile, "open in another program (process 12)"; empty: nobody can.
    std::string inUse = {};

    // What the save had when it was opened.
    std::int64_t format = kFormatVersion;  // an older one only where it is read alone
    Metadata metadata = {};
    WorldIdentity identity = {};
    BlockIdMap ids = {};
};

// To read and write. New names of block types are written already.
[[nodiscard]] base::Result<SaveFile> openToWrite(const std::filesystem::path& path,
                                                 const world::BlockRegistry& registry,
                                                 const SaveAccess& access);

// Changes nothing. A save that another program writes is read as it was at one moment, with what is in its
// log; what nobody writes stays so meanwhile. A transaction of the connection has begun, for more of that
// moment: COMMIT ends it. Busy where the other program is just making or migrating the save.
[[nodiscard]] base::Result<SaveFile> openToRead(const std::filesystem::path& path,
                                                const world::BlockRegistry& registry);

// The metadata alone. Errors as openToRead().
[[nodiscard]] base::Result<Metadata> readSavedMetadata(const std::filesystem::path& path);

// Whether the save, or a new one, could be written there: the file, its folder, their file system.
bool isWritable(const std::filesystem::path& path);

}  // namespace terrane::store
