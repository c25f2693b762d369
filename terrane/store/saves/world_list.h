// Lists, renames, copies and deletes the worlds in the folder of saves. A world's name is its file name
// without ".sqlite". It is called by the title screen; any thread may use it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/saves/file_lock.h"
#include "terrane/store/saves/world_identity.h"
#include "terrane/store/sqlite/sqlite.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::store {

// Returns whether the file is a server's or the map's database beside a world that exists. The files of a
// world are its save, and beside it the databases and files of a server and of the map.
bool belongsToAWorld(const std::filesystem::path& path);
// Returns the reason why a new world cannot have this file: it exists, or files of a deleted world would
// become part of it.
[[nodiscard]] base::Result<void> checkFree(const std::filesystem::path& save);

// Returns the world's databases: the save first, then those beside it.
std::vector<std::filesystem::path> databasesOf(const std::filesystem::path& save);
// All files that a world can have, whether they exist or not: its databases with their logs and locks, and a
// server's key and settings. Pure.
std::vector<std::filesystem::path> filesOf(const std::filesystem::path& save);
[[nodiscard]] base::Result<std::vector<FileLock>> lockAll(const std::vector<std::filesystem::path>& files);
// Checkpoints the log into the database, so that its file is complete.
[[nodiscard]] base::Result<void> checkpointLog(const std::filesystem::path& database);

using Moves = std::vector<std::pair<std::filesystem::path, std::filesystem::path>>;  // from, to
// Returns all files that follow a save to another name, itself included. Fails if one of them would replace
// another.
[[nodiscard]] base::Result<Moves> movesOf(const std::filesystem::path& from, const std::filesystem::path& to);
// Moves all files, or none.
[[nodiscard]] base::Result<void> moveAll(const Moves& moves);

[[nodiscard]] base::Result<void> removeFile(const std::filesystem::path& file);  // also if it is missing
[[nodiscard]] base::Result<void> removeDatabase(const std::filesystem::path& file);

struct WorldEntry {
    std::string name;
    std::filesystem::path path;
    WorldIdentity identity;
    Metadata metadata;                           // for example the player's position
    std::uintmax_t sizeBytes = 0;                // file and log
    std::filesystem::file_time_type lastPlayed;  // last write to the save
    std::string inUse;                           // "open in another program (process 12)"; empty: not open
    std::string problem;  // why it cannot be read, one line; identity and metadata are then empty
};

// Each save of the list is opened: in a folder with more saves, those that were played longest ago are left
// out, and a warning says how many there are.
constexpr std::size_t kMaxListedWorlds = 1000;

// Sorted by lastPlayed, newest first; empty if there is no folder.
std::vector<WorldEntry> listWorlds(const std::filesystem::path& folder, const world::BlockRegistry& blocks);

// Fails for a name that a new world cannot have: one that checkNewName() rejects, or that ends with
// ".sqlite", ".server", ".map" or a dot. base::normalizedName() gives the normal form of what was typed.
[[nodiscard]] base::Result<void> checkWorldName(std::string_view name);

// Also fails if there is such a world or one whose name looks alike, or a file that one left and the new one
// would take over. `former`: the name until now of a world that gets this one.
[[nodiscard]] base::Result<void> checkNewWorld(const std::filesystem::path& folder, std::string_view name,
                                               std::string_view former = {});

std::filesystem::path worldFile(const std::filesystem::path& folder, std::string_view name);
// Returns the world's thumbnail beside the save; may not exist.
std::filesystem::path thumbnailOf(const std::filesystem::path& save);

// Returns the first unused name of the form "World", "World 2", …; shortened if too long.
std::string unusedWorldName(const std::filesystem::path& folder, std::string_view name);

// The functions below also rename, delete or copy the thumbnail. A server's files and the map's cache are
// renamed with the world, or nothing is; a server's key and settings stay when the world is deleted. Errors:
// BadInput for an invalid or used name, NotFound, Busy if another program has the world, Incompatible for a
// link to rename or delete.
[[nodiscard]] base::Result<void> renameWorld(const std::filesystem::path& folder, std::string_view name,
                                             std::string_view newName);
[[nodiscard]] base::Result<void> deleteWorld(const std::filesystem::path& folder, std::string_view name);

struct SaveCopy {
    std::string name, newName;
};
// Copies the saved state, also while the world is played. A failed copy is removed.
[[nodiscard]] base::Result<void> copySave(const std::filesystem::path& folder, const SaveCopy& copy,
                                          const world::BlockRegistry& blocks, const CopyProgress& progress);

}  // namespace terrane::store
