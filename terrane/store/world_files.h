// The files of a world: its save, and beside it the databases and files of a server and of the map. Called by
// world_list.h; any thread.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/file_lock.h"

namespace terrane::store {

// Whether it is a server's or the map's database beside a world that exists.
bool belongsToAWorld(const std::filesystem::path& path);
// Why a new world cannot have this file: it exists, or files that another world left would become part of it.
[[nodiscard]] base::Result<void> checkFree(const std::filesystem::path& save);

// The world's databases: the save first, then those beside it.
std::vector<std::filesystem::path> databasesOf(const std::filesystem::path& save);
[[nodiscard]] base::Result<std::vector<FileLock>> lockAll(const std::vector<std::filesystem::path>& files);
// Checkpoints the log into the database, so that its file is complete.
[[nodiscard]] base::Result<void> endLog(const std::filesystem::path& database);

using Moves = std::vector<std::pair<std::filesystem::path, std::filesystem::path>>;  // from, to
// All files that follow a save to another name, itself included. Fails if one of them would replace another.
[[nodiscard]] base::Result<Moves> movesOf(const std::filesystem::path& from, const std::filesystem::path& to);
// All or nothing.
[[nodiscard]] base::Result<void> moveAll(const Moves& moves);

[[nodiscard]] base::Result<void> removeFile(const std::filesystem::path& file);  // also if it is missing
[[nodiscard]] base::Result<void> removeDatabase(const std::filesystem::path& file);

}  // namespace terrane::store
