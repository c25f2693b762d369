// The tables of a save, and the way from older formats to this one. docs/file-format.md describes them.
// Called while a save is opened, on the thread that opens it and uses its connection.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "terrane/store/block_id_map.h"
#include "terrane/store/metadata.h"
#include "terrane/store/sqlite.h"

namespace terrane::store {

constexpr std::int64_t kApplicationId = 0x5445524E;  // "TERN"; PRAGMA application_id
constexpr std::int64_t kFormatVersion = 3;           // PRAGMA user_version

// Saves of this format can be read as they are. Those of format 1 have chunks of level 0 alone.
constexpr std::int64_t kOldestReadable = 1;
// From this format on checksums cover keys, origins, settings and names of blocks.
constexpr std::int64_t kFirstWithChecksums = 3;

// SQL and a function that bring a save from format `from` to `from + 1`.
struct Migration {
    std::int64_t from;
    const char* sql;
    base::Result<void> (*run)(Database&) = nullptr;
};

// All there are. Never changed after a release, only added to.
std::span<const Migration> migrations();

enum class SaveKind {
    Empty,  // no tables: a new file, or one whose making was cut short
    Old,    // of a format that migrations lead on from
    Current,
};

// An error for what is not a save, damaged, or of a newer format than `current`.
[[nodiscard]] base::Result<SaveKind> classify(Database& database, std::int64_t current = kFormatVersion);

// Makes the tables of an empty file. All or nothing.
[[nodiscard]] base::Result<void> createTables(Database& database, const WorldIdentity& identity);

// Leads an old save to format `current`, step by step, all or nothing, after copying it to `backup`. A
// failure leaves no copy.
[[nodiscard]] base::Result<void> migrate(Database& database, std::span<const Migration> steps,
                                         std::int64_t current, const std::filesystem::path& backup);

[[nodiscard]] base::Result<std::vector<SavedName>> readBlockNames(Database& database);
[[nodiscard]] base::Result<Metadata> readMetadata(Database& database);

}  // namespace terrane::store
