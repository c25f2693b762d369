// The tables of a save, and the way from older formats to this one. docs/file-format.md describes them.
// Called while a save is opened, on the thread that opens it and uses its connection.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/store/block_id_map.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/sqlite.h"

namespace terrane::store {

constexpr std::int64_t kApplicationId = 0x5445524E;  // "TERN"; PRAGMA application_id
constexpr std::int64_t kFormatVersion = 1;           // PRAGMA user_version

// SQL that brings a save from format `from` to `from + 1`.
struct Migration {
    std::int64_t from;
    const char* sql;
};

// All there are: none yet. Never changed after a release, only added to.
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
[[nodiscard]] base::Result<std::map<std::string, std::string>> readSettings(Database& database);
// Whether the setting is part of the world's identity, which only making a save, or making it anew, writes.
bool isIdentitySetting(std::string_view name);
// From the settings; an error where one is missing or no number.
[[nodiscard]] base::Result<WorldIdentity> identityFrom(const std::map<std::string, std::string>& settings,
                                                       const std::string& path);

// A chunk's number in the tables: x and y from 0, in 28 bits each.
constexpr std::int64_t keyOf(world::ChunkPos pos) {
    return (std::int64_t{pos.x} - world::kMinChunk) << 28 | (std::int64_t{pos.y} - world::kMinChunk);
}

// What no position has the number of gives a position outside the world.
constexpr world::ChunkPos posOf(std::int64_t key) {
    constexpr std::int64_t kEnd = std::int64_t{1} << 56;
    if (key < 0 || key >= kEnd) return {world::kMaxChunk + 1, world::kMaxChunk + 1};
    return {static_cast<std::int32_t>((key >> 28) + world::kMinChunk),
            static_cast<std::int32_t>((key & ((1 << 28) - 1)) + world::kMinChunk)};
}

}  // namespace terrane::store
