#include "terrane/net/server_file.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/schema.h"

namespace terrane::net {
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

std::filesystem::path serverFilePath(const std::filesystem::path& world) {
    std::filesystem::path path = world;
    return path.replace_extension(".server.sqlite");
}

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
    return transaction.commit();
}

// Failed writes are kept and tried again, at the end once.
void ServerFile::run() {
    std::vector<Write> writes;
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [&] { return isEnding_ || !waiting_.empty() || !writes.empty(); });
        const bool isLast = isEnding_;
        std::ranges::move(waiting_, std::back_inserter(writes));
        waiting_.clear();
        const std::uint64_t number = queued_;
        lock.unlock();
        const auto done = writes.empty() ? base::Result<void>() : writeAll(writes);
        lock.lock();
        ++attempts_;
        if (done) {
            writes.clear();
            durable_ = number;
            problem_.clear();
        } else {
            if (problem_.empty()) base::logError("{}", done.error().message);
            problem_ = done.error().message;
        }
        written_.notify_all();
        if (isLast) return;
        if (!done) wake_.wait_for(lock, kTryAgain, [&] { return isEnding_; });
    }
}

}  // namespace terrane::net
