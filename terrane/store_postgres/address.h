// The address of a world in PostgreSQL:
// postgresql://[user[:password]@][host][:port]/database[?schema=NAME&…], as libpq parses it, with the
// additional parameter schema: a world is one schema. Missing parts come from the environment (PGHOST,
// PGUSER, PGPASSWORD, …) and from ~/.pgpass. Plain values.
#pragma once

#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::store_postgres {

constexpr std::string_view kDefaultSchema = "terrane";

struct Address {
    std::string url;     // for libpq, without the schema. May contain a password: never print
    std::string schema;  // 1 to 63 bytes
    // For messages: host, port, database and schema, without user and password.
    std::string shown;
};

// Whether a location is a PostgreSQL URL.
bool isPostgresUrl(std::string_view text);

// BadInput if libpq cannot parse it, or the schema's name is invalid. The message contains no part of the
// URL.
[[nodiscard]] base::Result<Address> addressOf(const std::string& url);

}  // namespace terrane::store_postgres
