// Compares the tables of a save with those of its format. A save is untrusted, and SQLite runs code of a
// schema: a view in place of a table, or a trigger. Called while a save is opened, before anything else is
// read, on the thread that opens it.
#pragma once

#include <string>
#include <string_view>

#include "terrane/store/sqlite.h"

namespace terrane::store {

// The SQL of the four tables, for all formats so far.
extern const char* const kTables;

// Fails with one line that names the first table, index, view or trigger that is missing, different or
// unexpected. Names, types, columns and constraints are compared; case, blanks and quotes are not.
[[nodiscard]] base::Result<void> checkSchema(Database& database);

// The tokens of SQL, lowercase, without quotes around plain names, separated by blanks. For tests.
std::string normalizedSql(std::string_view sql);

}  // namespace terrane::store
