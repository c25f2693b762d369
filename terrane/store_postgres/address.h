// Where a world in PostgreSQL is: postgresql://[user[:password]@][host][:port]/database[?schema=NAME&…], as
// libpq reads it, with one parameter of our own: a world is one schema. What a URL leaves out comes from the
// environment (PGHOST, PGUSER, PGPASSWORD, …) and from ~/.pgpass. Plain values.
#pragma once

#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::store_postgres {

constexpr std::string_view kDefaultSchema = "terrane";

struct Address {
    std::string url;     // for libpq, without the schema. May hold a password: never printed
    std::string schema;  // 1 to 63 bytes
    // For messages: host, port, database and schema, no user and no password.
    std::string shown;
};

// Whether a location is for this module.
bool isPostgresUrl(std::string_view text);

// BadInput where libpq cannot read it, or the schema has no such name. The message holds no part of the URL.
[[nodiscard]] base::Result<Address> addressOf(const std::string& url);

}  // namespace terrane::store_postgres
