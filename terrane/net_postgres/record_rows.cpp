#include "terrane/net_postgres/record_rows.h"

#include <limits>
#include <utility>

#include "terrane/game/player_state.h"
#include "terrane/net/server/server_records.h"

namespace terrane::net_postgres {
namespace {

using store_postgres::Command;
using store_postgres::Connection;
using store_postgres::Parameters;
using store_postgres::Rows;
using store_postgres::Statement;

constexpr std::int64_t kEditsInPage = 1000;
constexpr std::int64_t kLowest = std::numeric_limits<std::int64_t>::min(),
                       kHighest = std::numeric_limits<std::int64_t>::max();

constexpr Statement kPlayers = {"SELECT id, key, name, role, pose, ban FROM players"};
constexpr Statement kPlayer = {"SELECT id, key, name, role, pose, ban FROM players WHERE id = $1"};
constexpr Statement kClaims = {"SELECT name, x0, y0, x1, y1, owner, members FROM claims ORDER BY name"};
constexpr Statement kText = {"SELECT value FROM texts WHERE name = $1"};
constexpr Statement kPlaces = {"SELECT value FROM settings WHERE name = $1"};
constexpr Statement kEnds = {"SELECT newest, saved FROM history"};
// $1, $2: range of numbers; $3: player, negative for any; $4: time; $5, $6: chunks; $7: limit.
constexpr Statement kEditsUp = {
    "SELECT number, time, player, chunk, blocks FROM edits WHERE number > $1 AND number < $2 AND ($3 < 0 OR "
    "player = $3 OR player > 4294967295 AND (player & 4294967295 = $3 OR player >> 32 = $3)) AND time < $4 "
    "AND chunk BETWEEN $5 AND $6 ORDER BY number LIMIT $7"};
constexpr Statement kEditsDown = {
    "SELECT number, time, player, chunk, blocks FROM edits WHERE number > $1 AND number < $2 AND ($3 < 0 OR "
    "player = $3 OR player > 4294967295 AND (player & 4294967295 = $3 OR player >> 32 = $3)) AND time < $4 "
    "AND chunk BETWEEN $5 AND $6 ORDER BY number DESC LIMIT $7"};
constexpr Statement kAddPlayer = {
    "INSERT INTO players (id, key, name, role, pose, ban) VALUES ($1, $2, $3, $4, $5, $6) ON CONFLICT DO "
    "NOTHING"};
// An empty array leaves a column as it is.
constexpr Statement kChangePlayer = {
    "UPDATE players p SET name = CASE WHEN EXISTS (SELECT 1 FROM players o WHERE o.id <> $1 AND "
    "lower(o.name COLLATE \"C\") = lower(($2::text[])[1] COLLATE \"C\")) THEN name ELSE "
    "coalesce(($2::text[])[1], name) END, role = coalesce(($3::smallint[])[1], role), "
    "pose = coalesce(($4::text[])[1], pose), ban = coalesce(($5::text[])[1], ban) WHERE id = $1"};
constexpr Statement kAddClaim = {
    "INSERT INTO claims (name, x0, y0, x1, y1, owner, members) VALUES ($1, $2, $3, $4, $5, $6, $7) "
    "ON CONFLICT (name) DO NOTHING"};
constexpr Statement kRemoveClaim = {"DELETE FROM claims WHERE name = $1"};
constexpr Statement kSetText = {
    "INSERT INTO texts (name, value) VALUES ($1, $2) ON CONFLICT (name) DO UPDATE SET value = "
    "excluded.value"};
constexpr Statement kJoined = {
    "INSERT INTO online (player, server) SELECT $1, number FROM servers WHERE number = $2 "
    "ON CONFLICT (player) DO UPDATE SET server = excluded.server"};
constexpr Statement kElsewhere = {"SELECT player FROM online WHERE server <> $1"};
constexpr Statement kServerOf = {"SELECT server FROM online WHERE player = $1"};
constexpr Statement kLeft = {"DELETE FROM online WHERE player = $1 AND server = $2"};
constexpr Statement kSetSaved = {"UPDATE history SET saved = least(newest, greatest(saved, $1))"};
// New players take a number from the sequence; copied players may have a higher one.
constexpr Statement kSkipNumber = {
    "SELECT setval('player_numbers', $1) FROM player_numbers WHERE last_value < $1"};
constexpr Statement kNumbers = {"SELECT nextval('player_numbers') FROM generate_series(1, $1)"};

tl::unexpected<base::Error> damaged(const Connection& connection, std::string_view what) {
    return base::fail(base::ErrorCode::Damaged, "{}: damaged: {}", connection.shown(), what);
}

std::optional<net::KnownPlayer> playerOf(const Rows& rows, int row) {
    return net::knownPlayer({rows.number(row, 0), rows.bytes(row, 1), rows.text(row, 2), rows.number(row, 3),
                             rows.text(row, 4), rows.text(row, 5)});
}

std::vector<game::PlayerId> playersOf(const Rows& rows) {
    std::vector<game::PlayerId> players;
    for (int row = 0; row < rows.count(); ++row)
        players.push_back(static_cast<game::PlayerId>(rows.number(row, 0)));
    return players;
}

// An array of one value, or empty.
std::vector<std::string> textIfGiven(const std::optional<std::string>& text) {
    return text ? std::vector<std::string>{*text} : std::vector<std::string>{};
}

}  // namespace

base::Result<std::vector<net::KnownPlayer>> readPlayers(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kPlayers));
    std::vector<net::KnownPlayer> players;
    for (int row = 0; row < rows.count(); ++row) {
        auto player = playerOf(rows, row);
        if (!player) return damaged(connection, "a player");
        players.push_back(std::move(*player));
    }
    return players;
}

base::Result<std::optional<net::KnownPlayer>> readPlayer(Connection& connection, game::PlayerId id) {
    const auto rows = TERRANE_TRY(connection.run(kPlayer, Parameters().number(std::int64_t{id})));
    return rows.count() == 1 ? playerOf(rows, 0) : std::nullopt;
}

base::Result<std::vector<game::Claim>> readClaims(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kClaims));
    std::vector<game::Claim> claims;
    for (int row = 0; row < rows.count(); ++row) {
        auto claim = net::claimOf(
            {rows.text(row, 0),
             {rows.number(row, 1), rows.number(row, 2), rows.number(row, 3), rows.number(row, 4)},
             rows.number(row, 5),
             rows.text(row, 6)});
        if (!claim) return damaged(connection, "a claim");
        claims.push_back(std::move(*claim));
    }
    return claims;
}

base::Result<std::string> readText(Connection& connection, const std::string& name) {
    const auto rows = TERRANE_TRY(connection.run(kText, Parameters().text(name)));
    return rows.count() == 1 ? std::string(rows.text(0, 0)) : std::string();
}

base::Result<std::vector<game::Place>> readPlaces(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kPlaces, Parameters().text(game::kPlacesMetadata)));
    return game::placesFrom(rows.count() == 1 ? rows.text(0, 0) : std::string_view());
}

base::Result<net::HistoryEnds> readEnds(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kEnds));
    if (rows.count() != 1) return damaged(connection, "the table history does not have exactly one row");
    return net::HistoryEnds{rows.number(0, 0), rows.number(0, 1)};
}

base::Result<std::vector<game::PlayerId>> readElsewhere(Connection& connection, std::int64_t server) {
    const auto rows = TERRANE_TRY(connection.run(kElsewhere, Parameters().number(server)));
    return playersOf(rows);
}

base::Result<std::optional<std::int64_t>> readServerOf(Connection& connection, game::PlayerId player) {
    const auto rows = TERRANE_TRY(connection.run(kServerOf, Parameters().number(std::int64_t{player})));
    return rows.count() == 1 ? std::optional(rows.number(0, 0)) : std::nullopt;
}

base::Result<EditPage> readEdits(Connection& connection, const store::BlockIdMap& ids,
                                 const net::EditFilter& filter, net::EditOrder order,
                                 std::optional<std::int64_t> last) {
    const bool isUp = order == net::EditOrder::OldestFirst;
    const net::KeyRange chunks =
        filter.area ? net::chunkKeys(*filter.area) : net::KeyRange{kLowest, kHighest};
    const auto rows = TERRANE_TRY(connection.run(
        isUp ? kEditsUp : kEditsDown, Parameters()
                                          .number(isUp && last ? *last : filter.afterNumber)
                                          .number(!isUp && last ? *last : kHighest)
                                          .number(filter.player ? std::int64_t{*filter.player} : -1)
                                          .number(filter.beforeMs.value_or(kHighest))
                                          .number(chunks.first)
                                          .number(chunks.last)
                                          .number(kEditsInPage)));
    EditPage page;
    for (int row = 0; row < rows.count(); ++row) {
        auto edit =
            TERRANE_TRY(net::decodeEdit({rows.number(row, 0), rows.number(row, 1), rows.number(row, 2),
                                         rows.number(row, 3), rows.bytes(row, 4)},
                                        ids));
        if (net::isInArea(edit, filter)) page.edits.push_back(std::move(edit));
    }
    if (rows.count() == kEditsInPage) page.last = rows.number(rows.count() - 1, 0);
    return page;
}

base::Result<void> forEachEdit(const ReadEditPage& read, const net::UseEdit& use) {
    std::optional<std::int64_t> last;
    do {
        const auto page = TERRANE_TRY(read(last));
        for (const net::LoggedEdit& edit : page.edits) TERRANE_TRY(use(edit));
        last = page.last;
    } while (last);
    return {};
}

Command addPlayerCommand(const net::KnownPlayer& player) {
    return {&kAddPlayer, Parameters()
                             .number(std::int64_t{player.id})
                             .bytes(player.key)
                             .text(player.name)
                             .integer(static_cast<std::int32_t>(player.role))
                             .text(player.pose ? game::textOf(*player.pose) : std::string())
                             .text(player.ban)};
}

Command changePlayerCommand(game::PlayerId id, const net::PlayerChange& change) {
    const std::optional<std::string> pose =
        change.pose ? std::optional(game::textOf(*change.pose)) : std::nullopt;
    std::vector<std::int16_t> role;
    if (change.role) role.push_back(static_cast<std::int16_t>(*change.role));
    return {&kChangePlayer, Parameters()
                                .number(std::int64_t{id})
                                .texts(textIfGiven(change.name))
                                .smallNumbers(role)
                                .texts(textIfGiven(pose))
                                .texts(textIfGiven(change.ban))};
}

Command addClaimCommand(const game::Claim& claim) {
    return {&kAddClaim, Parameters()
                            .text(claim.name)
                            .integer(claim.area.x0)
                            .integer(claim.area.y0)
                            .integer(claim.area.x1)
                            .integer(claim.area.y1)
                            .number(std::int64_t{claim.owner})
                            .text(net::membersText(claim.members))};
}

Command removeClaimCommand(const std::string& name) {
    return {&kRemoveClaim, Parameters().text(name)};
}
Command setTextCommand(const std::string& name, const std::string& text) {
    return {&kSetText, Parameters().text(name).text(text)};
}
Command joinedCommand(game::PlayerId player, std::int64_t server) {
    return {&kJoined, Parameters().number(std::int64_t{player}).number(server)};
}
Command leftCommand(game::PlayerId player, std::int64_t server) {
    return {&kLeft, Parameters().number(std::int64_t{player}).number(server)};
}
Command setSavedCommand(std::int64_t number) {
    return {&kSetSaved, Parameters().number(number)};
}
Command skipPlayerNumberCommand(game::PlayerId player) {
    return {&kSkipNumber, Parameters().number(std::int64_t{player})};
}

base::Result<std::vector<game::PlayerId>> allocatePlayerIds(Connection& connection, std::size_t count) {
    const auto rows =
        TERRANE_TRY(connection.run(kNumbers, Parameters().integer(static_cast<std::int32_t>(count))));
    return playersOf(rows);
}

}  // namespace terrane::net_postgres
