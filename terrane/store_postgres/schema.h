// The tables of a world in PostgreSQL, and the way from older formats to this one. Called while a world is
// opened.
#pragma once

#include <span>

#include "terrane/store_postgres/connection.h"

namespace terrane::store_postgres {

// SQL that leads from a format to the next. A new world is format 0 and takes all of them. Never changed
// after a release, only added to.
std::span<const char* const> formatSteps();
inline int newestFormat() {
    return static_cast<int>(formatSteps().size());
}

inline constexpr Statement kPutSetting = {
    "INSERT INTO settings (name, value) VALUES ($1, $2) "
    "ON CONFLICT (name) DO UPDATE SET value = excluded.value"};
inline constexpr Statement kRemoveSetting = {"DELETE FROM settings WHERE name = $1"};

// The format of the world that the connection's schema holds; 0: there is no schema, or nothing in it.
// Incompatible where the schema holds other tables, or a format newer than `newest`.
[[nodiscard]] base::Result<int> formatOf(Connection& connection, int newest = newestFormat());

// Makes the schema and brings its tables to the newest format, in a transaction of the caller.
[[nodiscard]] base::Result<void> migrateInTransaction(Connection& connection, const std::string& schema,
                                                      int from,
                                                      std::span<const char* const> steps = formatSteps());
// The same in one of its own.
[[nodiscard]] base::Result<void> migrate(Connection& connection, const std::string& schema, int from,
                                         std::span<const char* const> steps = formatSteps());

// Incompatible where a table lacks a column, or has it by another type.
[[nodiscard]] base::Result<void> checkColumns(Connection& connection);

}  // namespace terrane::store_postgres
