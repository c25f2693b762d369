// The tables of a save, and migrations from older formats. docs/file-format.md describes them. It is called
// while a save is opened, on the thread that opens it and uses its connection.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/store/chunks/block_id_map.h"
#include "terrane/store/saves/world_identity.h"
#include "terrane/store/sqlite/sqlite.h"

namespace terrane::store {

constexpr std::int64_t kApplicationId = 0x5445524E;  // "TERN"; PRAGMA application_id
// PRAGMA user_version: of worlds of 0…255, which programs write that know no other heights, and of worlds of
// other heights. Their tables are the same; chunk data and world metadata differ.
constexpr std::int64_t kFormatVersion = 3, kTallFormatVersion = 4;
constexpr std::int64_t formatFor(world::Heights heights) {
    return heights == world::Heights() ? kFormatVersion : kTallFormatVersion;
}

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

// Returns all migrations. Released ones are never changed.
std::span<const Migration> migrations();

enum class SaveKind {
    Empty,  // no tables: a new file, or an interrupted creation
    Old,    // of a format that can be migrated
    Current,
};

// The formats that need no migration.
struct Formats {
    std::int64_t first = kFormatVersion, last = kTallFormatVersion;
};

// Fails if the file is not a save, is damaged, or has a newer format than the last one.
[[nodiscard]] base::Result<SaveKind> classify(Database& database, Formats current = {});

// Creates the tables of an empty file, all or nothing.
[[nodiscard]] base::Result<void> createTables(Database& database, const WorldIdentity& identity);

// Migrates an old save to format `current`, step by step, all or nothing, after copying it to `backup`. A
// failure leaves no copy.
[[nodiscard]] base::Result<void> migrate(Database& database, std::span<const Migration> steps,
                                         std::int64_t current, const std::filesystem::path& backup);

[[nodiscard]] base::Result<std::vector<SavedName>> readBlockNames(Database& database);
[[nodiscard]] base::Result<Metadata> readMetadata(Database& database);

// Compares the tables of a save with those of its format. A save is untrusted, and SQLite runs code of a
// schema: a view in place of a table, or a trigger. It is called while a save is opened, before anything else
// is read, on the thread that opens it. The SQL of the four tables, for all formats so far.
extern const char* const kTables;

// Fails with one line that names the first table, index, view or trigger that is missing, different or
// unexpected. Names, types, columns and constraints are compared; case, blanks and quotes are not.
[[nodiscard]] base::Result<void> checkSchema(Database& database);

// Returns the tokens of SQL, lowercase, without quotes around plain names, separated by blanks. For tests.
std::string normalizedSql(std::string_view sql);

// Upgrades format 2 to format 3: checksums of chunks that cover key and origin, and a checksum over settings
// and block names. A step of schema.cpp.
// Runs in the caller's transaction, with one row at a time in memory. Damaged rows stay as they are.
[[nodiscard]] base::Result<void> addChecksums(Database& database);

}  // namespace terrane::store
