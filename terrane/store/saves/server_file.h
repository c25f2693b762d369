// What the store knows of the file that a server keeps beside a world's, NAME.server.sqlite, with the history
// of edits (net/server/sqlite_records.h). Any thread.
#pragma once

#include <cstdint>
#include <filesystem>

#include "terrane/base/result.h"
#include "terrane/store/sqlite/sqlite.h"

namespace terrane::store {

// The path for a world's path: "a/home.sqlite" gives "a/home.server.sqlite".
std::filesystem::path serverFilePath(const std::filesystem::path& world);

struct HistoryEnds {
    std::int64_t newest = 0;  // number of the newest edit that is durable; 0: none
    std::int64_t saved = 0;   // all edits up to this one are in the world's own store
};

// Name in the table `state` of HistoryEnds::saved.
inline constexpr const char* kSavedEdit = "saved";

[[nodiscard]] base::Result<HistoryEnds> historyEnds(Database& serverFile);
// Errors name the file, which must exist.
[[nodiscard]] base::Result<HistoryEnds> readHistoryEnds(const std::filesystem::path& serverFile);

// Fails if a killed server left edits that are in the history alone: the next server brings them back, over
// what another program wrote meanwhile. A file that cannot be read does not count, since no server starts
// with it.
[[nodiscard]] base::Result<void> requireSavedHistory(const std::filesystem::path& world);

}  // namespace terrane::store
