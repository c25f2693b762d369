// Compares the tables of a save with those that its format has. A save may come from anybody, and SQLite runs
// what a schema holds: a view in a table's place, or a trigger, would be code of a stranger. Called while a
// save is opened, before anything else of it is read, on the thread that opens it.
#pragma once

#include <string>
#include <string_view>

#include "terrane/store/sqlite.h"

namespace terrane::store {

// The SQL of the four tables, for all formats so far.
extern const char* const kTables;

// An error, in one line, that names the first table, index, view or trigger that is missing, is another one
// or should not be there. Names, types, columns and constraints count; case, blanks and quotes do not.
[[nodiscard]] base::Result<void> checkSchema(Database& database);

// The tokens of SQL, in lower case and without quotes around plain names, separated by blanks. For tests.
std::string normalizedSql(std::string_view sql);

}  // namespace terrane::store
