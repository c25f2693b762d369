#include "terrane/net/sqlite_records.h"

#include <cassert>
#include <utility>

#include "terrane/game/pose_text.h"
#include "terrane/net/record_values.h"
#include "terrane/net/sqlite_edits.h"
#include "terrane/store/chunk_key.h"

namespace terrane::net {
namespace {

using store::Database;
using store::Statement;

constexpr const char* kSaved = "saved";  // a name in the table `state`

tl::unexpected<base::Error> damaged(const Database& database, std::string_view what) {
    return base::fail(base::ErrorCode::Damaged, "{}: damaged: {}", database.path(), what);
}

base::Result<std::int64_t> numberOr0(Database& database, const std::string& sql) {
    const auto number = TERRANE_TRY(database.queryNumber(sql));
    return number.value_or(0);
}

}  // namespace

base::Result<std::unique_ptr<SqliteRecords>> SqliteRecords::open(const std::filesystem::path& path,
                                                                 const world::BlockRegistry& blocks) {
    auto file = TERRANE_TRY(ServerFile::open(path, blocks));
    return std::make_unique<SqliteRecords>(std::move(file));
}

base::Result<std::vector<KnownPlayer>> SqliteRecords::players() {
    std::vector<KnownPlayer> players;
    const auto take = [&](const Statement& row) -> base::Result<void> {
        auto player =
            knownPlayer({row.number(0), row.blob(1), row.text(2), row.number(3), row.text(4), row.text(5)});
        if (!player) return damaged(file_->reader(), "a player");
        players.push_back(std::move(*player));
        return {};
    };
    const auto read =
        store::forEachRow(file_->reader(), "SELECT id, key, name, role, pose, ban FROM players", take);
    if (!read) return tl::unexpected(read.error());
    return players;
}

base::Result<std::vector<game::Claim>> SqliteRecords::claims() {
    std::vector<game::Claim> claims;
    const auto take = [&](const Statement& row) -> base::Result<void> {
        auto claim = claimOf({row.text(0),
                              {row.number(1), row.number(2), row.number(3), row.number(4)},
                              row.number(5),
                              row.text(6)});
        if (!claim) return damaged(file_->reader(), "a claim");
        claims.push_back(std::move(*claim));
        return {};
    };
    const auto read =
        store::forEachRow(file_->reader(), "SELECT name, x0, y0, x1, y1, owner, members FROM claims", take);
    if (!read) return tl::unexpected(read.error());
    return claims;
}

base::Result<std::string> SqliteRecords::text(const std::string& name) {
    auto query = TERRANE_TRY(file_->reader().prepare("SELECT value FROM texts WHERE name = ?1"));
    query.bind(1, name);
    const auto row = TERRANE_TRY(query.step());
    return row ? std::string(query.text(0)) : std::string();
}

base::Result<HistoryEnds> SqliteRecords::historyEnds() {
    const auto newest = numberOr0(file_->reader(), "SELECT max(number) FROM edits");
    const auto saved =
        numberOr0(file_->reader(), fmt::format("SELECT value FROM state WHERE name = '{}'", kSaved));
    if (!newest || !saved) return tl::unexpected((!newest ? newest : saved).error());
    return HistoryEnds{*newest, *saved};
}

base::Result<void> SqliteRecords::forEachEdit(const EditFilter& filter, EditOrder order, const UseEdit& use) {
    return net::forEachEdit(file_->reader(), file_->ids(), filter, order, use);
}

void SqliteRecords::addPlayer(const KnownPlayer& player) {
    file_->write([player](Database& database) -> base::Result<void> {
        auto put = TERRANE_TRY(database.prepare(
            "INSERT INTO players (id, key, name, role, pose, ban) VALUES (?1, ?2, ?3, ?4, ?5, ?6)"));
        put.bind(1, std::int64_t{player.id});
        put.bind(2, ByteView(player.key));
        put.bind(3, player.name);
        put.bind(4, static_cast<std::int64_t>(player.role));
        put.bind(5, player.pose ? game::textOf(*player.pose) : std::string());
        put.bind(6, player.ban);
        return put.run();
    });
}

void SqliteRecords::changePlayer(game::PlayerId id, const PlayerChange& change) {
    file_->write([id, change](Database& database) -> base::Result<void> {
        auto put = TERRANE_TRY(
            database.prepare("UPDATE players SET name = coalesce(?2, name), role = coalesce(?3, role), "
                             "pose = coalesce(?4, pose), ban = coalesce(?5, ban) WHERE id = ?1"));
        put.bind(1, std::int64_t{id});
        if (change.name) put.bind(2, *change.name);
        if (change.role) put.bind(3, static_cast<std::int64_t>(*change.role));
        if (change.pose) put.bind(4, game::textOf(*change.pose));
        if (change.ban) put.bind(5, *change.ban);
        return put.run();
    });
}

void SqliteRecords::addClaim(const game::Claim& claim) {
    file_->write([claim](store::Database& database) -> base::Result<void> {
        auto put = TERRANE_TRY(database.prepare(
            "INSERT INTO claims (name, x0, y0, x1, y1, owner, members) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)"));
        put.bind(1, claim.name);
        int column = 2;
        for (const std::int32_t v : {claim.area.x0, claim.area.y0, claim.area.x1, claim.area.y1})
            put.bind(column++, std::int64_t{v});
        put.bind(6, std::int64_t{claim.owner});
        put.bind(7, membersText(claim.members));
        return put.run();
    });
}

void SqliteRecords::removeClaim(const std::string& name) {
    file_->write([name](store::Database& database) -> base::Result<void> {
        auto erase = TERRANE_TRY(database.prepare("DELETE FROM claims WHERE name = ?1"));
        erase.bind(1, name);
        return erase.run();
    });
}

void SqliteRecords::setText(const std::string& name, const std::string& text) {
    file_->write([name, text](Database& database) -> base::Result<void> {
        auto put =
            TERRANE_TRY(database.prepare("INSERT OR REPLACE INTO texts (name, value) VALUES (?1, ?2)"));
        put.bind(1, name);
        put.bind(2, text);
        return put.run();
    });
}

namespace {

// A row of the table `edits`.
struct EncodedEdit {
    std::int64_t number, timeMs, player, chunk;
    Bytes blocks;
};

base::Result<void> insertEdits(Database& database, const std::vector<EncodedEdit>& edits) {
    auto insert = TERRANE_TRY(database.prepare(
        "INSERT INTO edits (number, time, player, chunk, blocks) VALUES (?1, ?2, ?3, ?4, ?5)"));
    for (const EncodedEdit& edit : edits) {
        insert.bind(1, edit.number);
        insert.bind(2, edit.timeMs);
        insert.bind(3, edit.player);
        insert.bind(4, edit.chunk);
        insert.bind(5, ByteView(edit.blocks));
        TERRANE_TRY(insert.run());
    }
    return {};
}

}  // namespace

std::uint64_t SqliteRecords::append(const std::vector<LoggedEdit>& edits) {
    std::vector<EncodedEdit> rows;
    for (const LoggedEdit& edit : edits) {
        assert(edit.number > 0 && "the server numbers edits");
        rows.push_back({edit.number, edit.timeMs, std::int64_t{edit.player}, store::keyOf(edit.chunk),
                        encodeEdit(edit, file_->ids())});
    }
    return file_->write([rows = std::move(rows)](Database& database) { return insertEdits(database, rows); });
}

void SqliteRecords::setSavedEdit(std::int64_t number) {
    file_->write([number](Database& database) {
        return database.execute(
            fmt::format("INSERT OR REPLACE INTO state (name, value) VALUES ('{}', {})", kSaved, number));
    });
}

}  // namespace terrane::net
