#include "terrane/net_postgres/server_rows.h"

#include "terrane/store/chunks/chunk_key.h"

namespace terrane::net_postgres {
namespace {

using store_postgres::Command;
using store_postgres::Connection;
using store_postgres::Parameters;
using store_postgres::Statement;

// Times are those of the database's clock, the only one that all servers share. It may be set back: then
// times lie in the future, so a server is gone also if its last heartbeat is too far ahead, and a lease has
// ended if it would last longer than any does. A server that runs writes a new time within a second.
constexpr Statement kAddServer = {
    "INSERT INTO servers (name, address, key, saved) SELECT $1, $2, $3, newest FROM history RETURNING "
    "number"};
constexpr Statement kPutServer = {
    "INSERT INTO servers (number, name, address, key, saved, players, seen) OVERRIDING SYSTEM VALUE "
    "VALUES ($1, $2, $3, $4, $5, $6, clock_timestamp()) ON CONFLICT (number) DO UPDATE SET saved = "
    "excluded.saved, "
    "players = excluded.players, seen = excluded.seen, address = excluded.address, key = excluded.key"};
constexpr Statement kRemoveServer = {"DELETE FROM servers WHERE number = $1"};
constexpr Statement kRemoveLeases = {"DELETE FROM growth_leases WHERE server = $1"};
constexpr Statement kForgetServer = {
    "WITH gone AS (DELETE FROM servers WHERE number = $1 AND seen NOT BETWEEN clock_timestamp() - $2 * "
    "interval '1 second' AND clock_timestamp() + $2 * interval '1 second' RETURNING number) "
    "DELETE FROM growth_leases USING gone WHERE server = gone.number"};
// Updates the row only if the value rises, since appends write the row, too.
constexpr Statement kRaiseSaved = {
    "WITH now AS (SELECT coalesce((SELECT min(saved) FROM servers), $1) AS saved) "
    "UPDATE history SET saved = least(newest, now.saved) FROM now WHERE history.saved < least(newest, "
    "now.saved)"};
constexpr Statement kSaved = {"SELECT saved FROM history"};
constexpr Statement kOtherServers = {
    "SELECT number, name, address, key, "
    "seen BETWEEN clock_timestamp() - $2 * interval '1 second' AND clock_timestamp() + $2 * interval '1 "
    "second' FROM servers WHERE number <> $1 ORDER BY number"};
constexpr Statement kLease = {
    "INSERT INTO growth_leases (region, server, until) SELECT region, $2, clock_timestamp() + $3 * interval "
    "'1 second' FROM unnest($1::bigint[]) AS region ORDER BY region ON CONFLICT (region) DO UPDATE SET "
    "server = excluded.server, until = excluded.until WHERE growth_leases.server = excluded.server OR "
    "growth_leases.until < clock_timestamp() OR growth_leases.until > clock_timestamp() + $3 * interval '2 "
    "seconds'"};
constexpr Statement kLeased = {
    "SELECT region FROM growth_leases WHERE server = $1 AND until > clock_timestamp()"};
constexpr Statement kUnsaved = {
    "SELECT DISTINCT chunk FROM edits WHERE number > (SELECT saved FROM servers WHERE number = $1) AND "
    "server = $1"};

}  // namespace

base::Result<std::int64_t> addServer(Connection& connection, const ServerName& name) {
    const auto rows = TERRANE_TRY(
        connection.run(kAddServer, Parameters().text(name.name).text(name.address).text(name.key)));
    return rows.number(0, 0);
}

base::Result<void> removeServer(Connection& connection, std::int64_t server, std::int64_t saved) {
    const std::vector<Command> commands = {{&kRemoveServer, Parameters().number(server)},
                                           {&kRemoveLeases, Parameters().number(server)},
                                           {&kRaiseSaved, Parameters().number(saved)}};
    return connection.changeAll(commands);
}

Command removeServerCommand(std::int64_t server) {
    return {&kForgetServer, Parameters().number(server).number(kGoneSeconds)};
}

base::Result<BeatAnswer> beat(Connection& connection, const ServerName& name, const ServerBeat& state) {
    const std::vector<Command> commands = {
        {&kPutServer, Parameters()
                          .number(state.server)
                          .text(name.name)
                          .text(name.address)
                          .text(name.key)
                          .number(state.saved)
                          .integer(state.players)},
        {&kRaiseSaved, Parameters().number(state.saved)},
        {&kLease, Parameters().numbers(state.regions).number(state.server).number(kGoneSeconds)},
        {&kSaved},
        {&kOtherServers, Parameters().number(state.server).number(kGoneSeconds)},
        {&kLeased, Parameters().number(state.server)}};
    const auto rows = TERRANE_TRY(connection.runAll(commands));
    BeatAnswer answer;
    answer.saved = rows[3].number(0, 0);
    const store_postgres::Rows& others = rows[4];
    for (int row = 0; row < others.count(); ++row)
        answer.others.push_back({others.number(row, 0), std::string(others.text(row, 1)),
                                 std::string(others.text(row, 2)), std::string(others.text(row, 3)),
                                 others.number(row, 4) != 0});
    for (int row = 0; row < rows[5].count(); ++row) answer.regions.push_back(rows[5].number(row, 0));
    return answer;
}

base::Result<std::vector<world::ChunkPos>> unsavedChunks(Connection& connection, std::int64_t server) {
    const auto rows = TERRANE_TRY(connection.run(kUnsaved, Parameters().number(server)));
    std::vector<world::ChunkPos> chunks;
    for (int row = 0; row < rows.count(); ++row) chunks.push_back(store::posOf(rows.number(row, 0)));
    return chunks;
}

}  // namespace terrane::net_postgres
