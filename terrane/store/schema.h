// The tables of a save, and migrations from older formats. docs/file-format.md describes them. Called while a
// save is opened, on the thread that opens it and uses its connection.
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

// The oldest format that can be read without migration. Saves of format 1 only have chunks of level 0.
constexpr std::int64_t kOldestReadable = 1;
// The first format whose checksums cover keys, origins, settings and block names.
constexpr std::int64_t kFirstWithChecksums = 3;

// SQL and a function that migrate a save from format `from` to `from + 1`.
struct Migration {
    std::int64_t from;
    const char* sql;
    base::Result<void> (*run)(Database&) = nullptr;
};

// All migrations. Released ones are never changed.
std::span<const Migration> migrations();

enum class SaveKind {
    Empty,  // no tables: a new file, or an interrupted creation
    Old,    // of a format that can be migrated
    Current,
};

// Fails if the file is not a save, is damaged, or has a newer format than `current`.
[[nodiscard]] base::Result<SaveKind> classify(Database& database, std::int64_t current = kFormatVersion);

// Creates the tables of an empty file, all or nothing.
[[nodiscard]] base::Result<void> createTables(Database& database, const WorldIdentity& identity);

// Migrates an old save to format `current`, step by step, all or nothing, after copying it to `backup`. A
// failure leaves no copy.
[[nodiscard]] base::Result<void> migrate(Database& database, std::span<const Migration> steps,
                                         std::int64_t current, const std::filesystem::path& backup);

[[nodiscard]] base::Result<std::vector<SavedName>> readBlockNames(Database& database);
[[nodiscard]] base::Result<Metadata> readMetadata(Database& database);

}  // namespace terrane::store
