#include "terrane/net/server/sqlite_records.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <iterator>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/timing.h"
#include "terrane/game/player_state.h"
#include "terrane/net/server/server_records.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/saves/save_file.h"
#include "terrane/store/sqlite/schema.h"

namespace terrane::net {

namespace {

std::string queryOf(const EditFilter& filter, EditOrder order) {
    std::string sql = fmt::format("SELECT number, time, player, chunk, blocks FROM edits WHERE number > {}",
                                  filter.afterNumber);
    // The upper half of the number is a pack's (game::numberOf()).
    if (filter.player)
        sql +=
            fmt::format(" AND (player = {0} OR player > {1} AND (player & {1} = {0} OR player >> 32 = {0}))",
                        *filter.player, 0xFFFFFFFFu);
    if (filter.beforeMs) sql += fmt::format(" AND time < {}", *filter.beforeMs);
    if (filter.area) {
        const KeyRange keys = chunkKeys(*filter.area);
        sql += fmt::format(" AND chunk BETWEEN {} AND {}", keys.first, keys.last);
    }
    return sql + (order == EditOrder::OldestFirst ? " ORDER BY number" : " ORDER BY number DESC");
}

}  // namespace

base::Result<void> forEachEdit(store::Database& database, const store::BlockIdMap& ids,
                               const EditFilter& filter, EditOrder order, const UseEdit& use) {
    const auto take = [&](const store::Statement& row) -> base::Result<void> {
        const auto edit = TERRANE_TRY(
            decodeEdit({row.number(0), row.number(1), row.number(2), row.number(3), row.blob(4)}, ids));
        return isInArea(edit, filter) ? use(edit) : base::Result<void>();
    };
    return store::forEachRow(database, queryOf(filter, order), take);
}

namespace {

constexpr std::int64_t kApplicationId = 0x54455253;  // "TERS"
constexpr std::int64_t kFormatVersion = 1;
constexpr std::chrono::milliseconds kTryAgain{500};

constexpr const char* kTables =
    "CREATE TABLE blocks (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE);"
    "CREATE TABLE state (name TEXT PRIMARY KEY NOT NULL, value INTEGER NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE texts (name TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE players (id INTEGER PRIMARY KEY, key BLOB NOT NULL UNIQUE, name TEXT NOT NULL UNIQUE, role "
    "INTEGER NOT "
    "NULL, pose TEXT NOT NULL, ban TEXT NOT NULL);"
    "CREATE TABLE claims (name TEXT PRIMARY KEY NOT NULL, x0 INTEGER NOT NULL, y0 INTEGER NOT NULL, x1 "
    "INTEGER NOT NULL, "
    "y1 INTEGER NOT NULL, owner INTEGER NOT NULL, members TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE edits (number INTEGER PRIMARY KEY, time INTEGER NOT NULL, player INTEGER NOT NULL, chunk "
    "INTEGER NOT "
    "NULL, blocks BLOB NOT NULL);"
    "CREATE INDEX edits_of_chunk ON edits (chunk, number);"
    "CREATE INDEX edits_of_player ON edits (player, number);";

base::Result<void> makeTables(store::Database& database) {
    auto transaction = TERRANE_TRY(store::Transaction::begin(database));
    const std::string marks =
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kApplicationId, kFormatVersion);
    TERRANE_TRY(database.execute(marks + kTables));
    return transaction.commit();
}

// Creates the tables in an empty file; refuses files of another kind or format.
base::Result<void> prepareTables(store::Database& database) {
    const auto tables = TERRANE_TRY(database.queryNumber("SELECT count(*) FROM sqlite_schema"));
    if (tables.value_or(0) == 0) return makeTables(database);
    const auto mark = database.queryNumber("PRAGMA application_id");
    const auto version = database.queryNumber("PRAGMA user_version");
    if (!mark || !version) return tl::unexpected((!mark ? mark : version).error());
    if (*mark != kApplicationId)
        return base::fail(base::ErrorCode::Incompatible, "{}: not the file of a server", database.path());
    if (*version != kFormatVersion)
        return base::fail(base::ErrorCode::Incompatible, "{}: unknown format {} of a server's file",
                          database.path(), version->value_or(0));
    return {};
}

// Adds block types that are new to the file.
base::Result<store::BlockIdMap> mapBlocks(store::Database& database, const world::BlockRegistry& blocks) {
    const auto names = TERRANE_TRY(store::readBlockNames(database));
    auto ids = store::BlockIdMap::make(blocks, names);
    if (!ids || ids->added().empty()) return ids;
    auto transaction = TERRANE_TRY(store::Transaction::begin(database));
    auto insert = TERRANE_TRY(database.prepare("INSERT INTO blocks (id, name) VALUES (?1, ?2)"));
    for (const store::SavedName& name : ids->added()) {
        insert.bind(1, std::int64_t{name.id});
        insert.bind(2, name.name);
        TERRANE_TRY(insert.run());
    }
    TERRANE_TRY(transaction.commit());
    return ids;
}

}  // namespace

base::Result<std::unique_ptr<ServerFile>> ServerFile::open(const std::filesystem::path& path,
                                                           const world::BlockRegistry& blocks) {
    auto lock = TERRANE_TRY(store::FileLock::acquire(path, store::FileLock::Kind::Exclusive));
    auto writer = TERRANE_TRY(store::Database::open(path, store::OpenMode::Create));
    TERRANE_TRY(writer.execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL"));
    TERRANE_TRY(prepareTables(writer));
    auto ids = TERRANE_TRY(mapBlocks(writer, blocks));
    auto reader = TERRANE_TRY(store::Database::open(path, store::OpenMode::ReadOnly));
    return std::unique_ptr<ServerFile>(
        new ServerFile(Parts{std::move(lock), std::move(writer), std::move(reader), std::move(ids)}));
}

ServerFile::ServerFile(Parts parts)
    : lock_(std::move(parts.lock)),
      writer_(std::move(parts.writer)),
      reader_(std::move(parts.reader)),
      files_(writer_.path()),
      ids_(std::move(parts.ids)),
      thread_([this] { run(); }) {}

ServerFile::~ServerFile() {
    {
        const std::lock_guard lock(mutex_);
        isEnding_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

std::uint64_t ServerFile::write(Write write) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(write));
    wake_.notify_all();
    return ++queued_;
}

std::shared_ptr<void> ServerFile::hold() {
    const std::lock_guard lock(mutex_);
    ++holds_;
    return {nullptr, [this](std::nullptr_t) {
                const std::lock_guard released(mutex_);
                if (--holds_ == 0) wake_.notify_all();
            }};
}

std::uint64_t ServerFile::durable() const {
    const std::lock_guard lock(mutex_);
    return durable_;
}

std::string ServerFile::problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
}

base::Result<void> ServerFile::flush() {
    std::unique_lock lock(mutex_);
    const std::uint64_t goal = queued_, before = attempts_;
    written_.wait(lock, [&] { return durable_ >= goal || (attempts_ > before && !problem_.empty()); });
    if (durable_ >= goal) return {};
    return base::fail(base::ErrorCode::Io, "{}", problem_);
}

base::Result<void> ServerFile::writeAll(const std::vector<Write>& writes) {
    auto transaction = TERRANE_TRY(store::Transaction::begin(writer_));
    for (const Write& write : writes) TERRANE_TRY(write(writer_));
    TERRANE_TRY(files_.check());
    return transaction.commit();
}

std::future<base::Result<store::Database>> ServerFile::readFromNow() {
    const std::lock_guard lock(mutex_);
    moments_.push_back({queued_, {}});
    wake_.notify_all();
    return moments_.back().opened.get_future();
}

// Up to the next moment, so that a reader can be opened there; at the end all.
void ServerFile::takeWaiting(std::vector<Write>& writes, bool isLast) {
    const std::uint64_t taken = queued_ - waiting_.size();
    const std::uint64_t end = isLast || moments_.empty() ? queued_ : moments_.front().write;
    assert(end >= taken && "no write is taken before the moments that precede it");
    const auto last = waiting_.begin() + static_cast<std::ptrdiff_t>(end - taken);
    std::move(waiting_.begin(), last, std::back_inserter(writes));
    waiting_.erase(waiting_.begin(), last);
}

namespace {

// A connection whose transaction has begun.
base::Result<store::Database> openAtMoment(const std::string& path) {
    auto database = TERRANE_TRY(store::Database::open(path, store::OpenMode::ReadOnly));
    TERRANE_TRY(database.execute("BEGIN"));
    (void)TERRANE_TRY(database.queryNumber("SELECT count(*) FROM state"));
    return database;
}

}  // namespace

// Called by the thread that writes: no other transaction begins meanwhile.
void ServerFile::answerMoments(std::unique_lock<std::mutex>& lock, const base::Result<void>& done) {
    while (!moments_.empty() && (!done || moments_.front().write <= durable_)) {
        Moment moment = std::move(moments_.front());
        moments_.pop_front();
        lock.unlock();
        moment.opened.set_value(done ? openAtMoment(reader_.path()) : tl::unexpected(done.error()));
        lock.lock();
    }
}

// Failed writes are kept and tried again, at the end once.
void ServerFile::run() {
    std::vector<Write> writes;
    base::FailureReport report(base::kQuietAfterFailure);
    std::unique_lock lock(mutex_);
    const auto isDue = [&] {
        return isEnding_ || (holds_ == 0 && (!waiting_.empty() || !writes.empty() || !moments_.empty()));
    };
    const auto reportIfEnded = [&] {
        if (report.hasEnded(std::chrono::steady_clock::now()))
            base::logInfo("{}: it works again", writer_.path());
    };
    while (true) {
        if (report.reportAt() == base::FailureReport::Time::max()) {
            wake_.wait(lock, isDue);
        } else if (!wake_.wait_until(lock, report.reportAt(), isDue)) {
            reportIfEnded();
            continue;
        }
        const bool isLast = isEnding_;
        takeWaiting(writes, isLast);
        const std::uint64_t number = queued_ - waiting_.size();
        lock.unlock();
        const auto done = writes.empty() ? base::Result<void>() : writeAll(writes);
        lock.lock();
        ++attempts_;
        if (done) {
            writes.clear();
            durable_ = number;
            problem_.clear();
            reportIfEnded();
        } else {
            if (report.hasBegun()) base::logError("{}", done.error().message);
            problem_ = done.error().message;
        }
        written_.notify_all();
        answerMoments(lock, isLast ? base::Result<void>(base::fail("the server ends")) : done);
        if (isLast) return;
        if (!done) wake_.wait_for(lock, kTryAgain, [&] { return isEnding_; });
    }
}

namespace {

using store::Database;
using store::Statement;

tl::unexpected<base::Error> damaged(const Database& database, std::string_view what) {
    return base::fail(base::ErrorCode::Damaged, "{}: damaged: {}", database.path(), what);
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
    return store::historyEnds(file_->reader());
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
        rows.push_back({edit.number, edit.timeMs, authorNumber(edit), store::keyOf(edit.chunk),
                        encodeEdit(edit, file_->ids())});
    }
    return file_->write([rows = std::move(rows)](Database& database) { return insertEdits(database, rows); });
}

namespace {

base::Result<void> writeSavedEdit(Database& database, std::int64_t number) {
    return database.execute(fmt::format("INSERT OR REPLACE INTO state (name, value) VALUES ('{}', {})",
                                        store::kSavedEdit, number));
}

}  // namespace

void SqliteRecords::setSavedEdit(std::int64_t number) {
    file_->write([number](Database& database) { return writeSavedEdit(database, number); });
}

base::Result<void> setSavedEdit(const std::filesystem::path& file, std::int64_t number) {
    auto database = TERRANE_TRY(Database::open(file, store::OpenMode::ReadWrite));
    return writeSavedEdit(database, number);
}

store::WriteCopy SqliteRecords::copyFromNow() {
    const auto opening = std::make_shared<std::future<base::Result<Database>>>(file_->readFromNow());
    return [opening](const std::filesystem::path& target,
                     const store::CopyProgress& progress) -> base::Result<void> {
        auto database = TERRANE_TRY(opening->get());
        return database.backUpTo(target, progress);
    };
}

// First the number up to which the world has all edits, then the world, then the history, which is written
// before the world: the history has all edits of the world.
base::Result<SavedCopy> copySaved(const std::filesystem::path& world, const world::BlockRegistry& blocks) {
    const std::filesystem::path records = store::serverFilePath(world);
    std::error_code ignored;
    const bool hasRecords = std::filesystem::exists(records, ignored);
    HistoryEnds before;
    if (hasRecords) {
        auto ends = TERRANE_TRY(store::readHistoryEnds(records));
        before = ends;
    }
    auto opened = TERRANE_TRY(store::openToRead(world, blocks));
    const auto save = std::make_shared<store::SaveFile>(std::move(opened));
    SavedCopy copy;
    copy.world = [save](const std::filesystem::path& target, const store::CopyProgress& progress) {
        return save->database.backUpTo(target, progress);
    };
    if (!hasRecords) return copy;
    auto history = TERRANE_TRY(openAtMoment(records.string()));
    const auto database = std::make_shared<Database>(std::move(history));
    copy.records = [database, before](const std::filesystem::path& target,
                                      const store::CopyProgress& progress) -> base::Result<void> {
        TERRANE_TRY(database->backUpTo(target, progress));
        return net::setSavedEdit(target, before.saved);
    };
    return copy;
}

}  // namespace terrane::net
