// Opens the file of a save: validates it, takes the lock, creates or migrates the tables. Called by the
// stores and by save_check.cpp, on the thread that opens the save; the result is used by one thread at a
// time.
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
