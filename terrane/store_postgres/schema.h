// The tables of a world in PostgreSQL, and migrations from older formats. Called while a world is opened.
#pragma once

#include <span>

#include "terrane/store_postgres/connection.h"
#include "terrane/world/heights.h"

namespace terrane::store_postgres {

// SQL that migrates each format to the next. A new world has format 0 and takes all steps. Released steps are
// never changed.
std::span<const char* const> formatSteps();
inline int newestFormat() {
    return static_cast<int>(formatSteps().size());
}
// Worlds of other heights than 0…255 have the same tables. Their format is greater by one, so that programs
// that know only 0…255 refuse them.
inline int formatFor(world::Heights heights) {
    return newestFormat() + (heights == world::Heights() ? 0 : 1);
}

inline constexpr Statement kPutSetting = {
    "INSERT INTO settings (name, value) VALUES ($1, $2) "
    "ON CONFLICT (name) DO UPDATE SET value = excluded.value"};
inline constexpr Statement kRemoveSetting = {"DELETE FROM settings WHERE name = $1"};

// The format of the world in the connection's schema; 0 if the schema is missing or empty. Incompatible if
// the schema holds other tables, or a format newer than `newest`.
[[nodiscard]] base::Result<int> formatOf(Connection& connection, int newest = newestFormat() + 1);

// Creates the schema if needed and migrates its tables to the newest format, in the caller's transaction.
[[nodiscard]] base::Result<void> migrateInTransaction(Connection& connection, const std::string& schema,
                                                      int from,
                                                      std::span<const char* const> steps = formatSteps());
// The same in its own transaction.
[[nodiscard]] base::Result<void> migrate(Connection& connection, const std::string& schema, int from,
                                         std::span<const char* const> steps = formatSteps());

// Incompatible if a column is missing or has another type.
[[nodiscard]] base::Result<void> checkColumns(Connection& connection);

}  // namespace terrane::store_postgres
