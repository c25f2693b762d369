#include "terrane/store_postgres/schema.h"

#include <map>

namespace terrane::store_postgres {
namespace {

using base::ErrorCode;

// Chunk data is already compressed. Rows up to a page are stored inline, which saves a lookup in another
// table. `version`: the row includes all edits of the history up to this one.
constexpr const char* kWorldTables = R"(
CREATE TABLE terrane_format (format integer NOT NULL);
CREATE TABLE settings (name text COLLATE "C" PRIMARY KEY, value text NOT NULL);
CREATE TABLE blocks (id integer PRIMARY KEY CHECK (id BETWEEN 0 AND 65535), name text COLLATE "C" NOT NULL UNIQUE);
CREATE TABLE chunks (key bigint PRIMARY KEY, origin smallint NOT NULL CHECK (origin IN (0, 1)), data bytea NOT NULL,
    version bigint NOT NULL DEFAULT 0) WITH (toast_tuple_target = 8160);
ALTER TABLE chunks ALTER COLUMN data SET STORAGE EXTERNAL;
CREATE INDEX edited_chunks ON chunks (key) WHERE origin = 1;
CREATE TABLE quarantine (number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, key bigint NOT NULL,
    reason text NOT NULL, data bytea NOT NULL);
)";

// The queue of `terrane work`. Jobs are squares of chunks, ordered by area and place. state: 0 waiting, 1
// done, 2 cancelled; a job in progress is waiting with a lease.
constexpr const char* kWorkTables = R"(
CREATE TABLE work_state (is_paused boolean NOT NULL);
INSERT INTO work_state VALUES (false);
CREATE TABLE work_areas (number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, x0 integer NOT NULL, y0 integer NOT NULL,
    x1 integer NOT NULL, y1 integer NOT NULL, added timestamptz NOT NULL DEFAULT now());
CREATE TABLE jobs (number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, area bigint NOT NULL REFERENCES work_areas,
    place bigint NOT NULL, x0 integer NOT NULL, y0 integer NOT NULL, x1 integer NOT NULL, y1 integer NOT NULL,
    state smallint NOT NULL DEFAULT 0, worker bigint, lease timestamptz, attempts integer NOT NULL DEFAULT 0);
CREATE INDEX waiting_jobs ON jobs (area, place) WHERE state = 0;
CREATE TABLE workers (number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, name text NOT NULL,
    started timestamptz NOT NULL DEFAULT now(), seen timestamptz NOT NULL DEFAULT now(),
    chunks bigint NOT NULL DEFAULT 0, rate double precision NOT NULL DEFAULT 0, job bigint);
)";

// Tables of servers. `edits` is the history, numbered without gaps in the order of acceptance; `write` is the
// number of the server's write that the edit belongs to. Edits up to history.saved are in `chunks`;
// history.openings counts exclusive openings and regenerations.
constexpr const char* kServerTables = R"(
CREATE TABLE texts (name text PRIMARY KEY, value text NOT NULL);
CREATE SEQUENCE player_numbers MINVALUE 2;
CREATE TABLE players (id bigint PRIMARY KEY, key bytea NOT NULL UNIQUE, name text NOT NULL, role smallint NOT NULL,
    pose text NOT NULL, ban text NOT NULL);
CREATE UNIQUE INDEX player_names ON players (lower(name COLLATE "C"));
CREATE TABLE claims (name text PRIMARY KEY, x0 integer NOT NULL, y0 integer NOT NULL, x1 integer NOT NULL,
    y1 integer NOT NULL, owner bigint NOT NULL, members text NOT NULL);
CREATE TABLE edits (number bigint PRIMARY KEY, time bigint NOT NULL, player bigint NOT NULL, chunk bigint NOT NULL,
    server bigint NOT NULL, write bigint NOT NULL, blocks bytea NOT NULL);
CREATE INDEX edits_of_chunk ON edits (chunk, number);
CREATE INDEX edits_of_player ON edits (player, number);
CREATE TABLE history (newest bigint NOT NULL, saved bigint NOT NULL, openings bigint NOT NULL DEFAULT 0);
INSERT INTO history VALUES (0, 0);
CREATE TABLE servers (number bigint GENERATED ALWAYS AS IDENTITY PRIMARY KEY, name text NOT NULL, address text NOT NULL,
    key text NOT NULL, players integer NOT NULL DEFAULT 0, saved bigint NOT NULL,
    started timestamptz NOT NULL DEFAULT now(), seen timestamptz NOT NULL DEFAULT now());
CREATE TABLE online (player bigint PRIMARY KEY, server bigint NOT NULL REFERENCES servers ON DELETE CASCADE);
CREATE TABLE growth_leases (region bigint PRIMARY KEY, server bigint NOT NULL, until timestamptz NOT NULL);
)";

constexpr const char* kSteps[] = {kWorldTables, kWorkTables, kServerTables};

// Columns whose types the program relies on.
struct Column {
    const char *table, *column, *type;
};
constexpr Column kColumns[] = {
    {"terrane_format", "format", "integer"},
    {"settings", "name", "text"},
    {"settings", "value", "text"},
    {"blocks", "id", "integer"},
    {"blocks", "name", "text"},
    {"chunks", "key", "bigint"},
    {"chunks", "origin", "smallint"},
    {"chunks", "data", "bytea"},
    {"chunks", "version", "bigint"},
    {"quarantine", "number", "bigint"},
    {"quarantine", "key", "bigint"},
    {"quarantine", "reason", "text"},
    {"quarantine", "data", "bytea"},
    {"work_state", "is_paused", "boolean"},
    {"work_areas", "number", "bigint"},
    {"jobs", "number", "bigint"},
    {"jobs", "state", "smallint"},
    {"workers", "number", "bigint"},
    {"players", "id", "bigint"},
    {"edits", "number", "bigint"},
    {"edits", "blocks", "bytea"},
    {"history", "newest", "bigint"},
    {"history", "saved", "bigint"},
    {"history", "openings", "bigint"},
    {"servers", "number", "bigint"},
};

// current_schema() is NULL for a schema that the user may not use.
constexpr Statement kCountTables = {
    "SELECT count(*), count(*) FILTER (WHERE relname = 'terrane_format' AND relkind = 'r'), "
    "current_schema() IS NULL AND EXISTS (SELECT 1 FROM pg_namespace WHERE nspname = "
    "(parse_ident(current_setting('search_path')))[1]) FROM pg_class "
    "WHERE relnamespace = (SELECT oid FROM pg_namespace WHERE nspname = current_schema()) "
    "AND relkind IN ('r', 'p', 'v', 'm', 'f')"};
constexpr Statement kCountSchemas = {"SELECT count(*) FROM pg_namespace WHERE nspname = $1"};
constexpr Statement kFormat = {"SELECT format::bigint FROM terrane_format"};
// Not from information_schema, which omits columns without privileges.
constexpr Statement kColumnTypes = {
    "SELECT relname::text, attname::text, format_type(atttypid, NULL) FROM pg_attribute "
    "JOIN pg_class ON pg_class.oid = attrelid WHERE relkind IN ('r', 'p') AND attnum > 0 AND NOT "
    "attisdropped "
    "AND relnamespace = (SELECT oid FROM pg_namespace WHERE nspname = current_schema())"};

}  // namespace

std::span<const char* const> formatSteps() {
    return kSteps;
}

base::Result<int> formatOf(Connection& connection, int newest) {
    const auto tables = TERRANE_TRY(connection.run(kCountTables));
    if (tables.number(0, 2) != 0)
        return base::fail(ErrorCode::Refused, "{}: this user may not use the schema", connection.shown());
    if (tables.number(0, 0) == 0) return 0;
    if (tables.number(0, 1) == 0)
        return base::fail(ErrorCode::Incompatible,
                          "{}: the schema holds tables of another program, not a world", connection.shown());
    const auto format = TERRANE_TRY(connection.run(kFormat));
    const std::int64_t number = format.count() == 1 ? format.number(0, 0) : 0;
    if (number < 1)
        return base::fail(ErrorCode::Damaged, "{}: damaged: its format is not one number above 0",
                          connection.shown());
    if (number > newest)
        return base::fail(ErrorCode::Incompatible,
                          "{}: in format {}, this program reads up to format {}: use a newer version",
                          connection.shown(), number, newest);
    return static_cast<int>(number);
}

base::Result<void> migrateInTransaction(Connection& connection, const std::string& schema, int from,
                                        std::span<const char* const> steps) {
    const auto schemas = TERRANE_TRY(connection.run(kCountSchemas, Parameters().text(schema)));
    std::string sql;
    // Not "IF NOT EXISTS", which requires the privilege to create schemas.
    if (schemas.number(0, 0) == 0) sql += fmt::format("CREATE SCHEMA {};", connection.quoted(schema));
    for (const char* step : steps.subspan(static_cast<std::size_t>(from))) sql += step;
    sql += fmt::format("DELETE FROM terrane_format; INSERT INTO terrane_format VALUES ({})", steps.size());
    return connection.execute(sql);
}

base::Result<void> migrate(Connection& connection, const std::string& schema, int from,
                           std::span<const char* const> steps) {
    return inTransaction(connection, [&] { return migrateInTransaction(connection, schema, from, steps); });
}

base::Result<void> checkColumns(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kColumnTypes));
    std::map<std::pair<std::string_view, std::string_view>, std::string_view> types;
    for (int row = 0; row < rows.count(); ++row)
        types[{rows.text(row, 0), rows.text(row, 1)}] = rows.text(row, 2);
    for (const auto& [table, column, type] : kColumns) {
        const auto found = types.find({table, column});
        if (found == types.end() || found->second != type)
            return base::fail(ErrorCode::Incompatible, "{}: not a world: {}.{} is {}, expected {}",
                              connection.shown(), table, column,
                              found == types.end() ? "missing" : found->second, type);
    }
    return {};
}

}  // namespace terrane::store_postgres
