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
    auto transaction = store::Transaction::begin(database);
    if (!transaction) return tl::unexpected(transaction.error());
    const std::string marks =
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kApplicationId, kFormatVersion);
    if (auto done = database.execute(marks + kTables); !done) return done;
    return transaction->commit();
}

// Creates the tables in an empty file; refuses files of another kind or format.
base::Result<void> prepareTables(store::Database& database) {
    const auto tables = database.queryNumber("SELECT count(*) FROM sqlite_schema");
    if (!tables) return tl::unexpected(tables.error());
    if (tables->value_or(0) == 0) return makeTables(database);
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
    const auto names = store::readBlockNames(database);
    if (!names) return tl::unexpected(names.error());
    auto ids = store::BlockIdMap::make(blocks, *names);
    if (!ids || ids->added().empty()) return ids;
    auto transaction = store::Transaction::begin(database);
    if (!transaction) return tl::unexpected(transaction.error());
    auto insert = database.prepare("INSERT INTO blocks (id, name) VALUES (?1, ?2)");
    if (!insert) return tl::unexpected(insert.error());
    for (const store::SavedName& name : ids->added()) {
        insert->bind(1, std::int64_t{name.id});
        insert->bind(2, name.name);
        if (auto done = insert->run(); !done) return tl::unexpected(done.error());
    }
    if (auto done = transaction->commit(); !done) return tl::unexpected(done.error());
    return ids;
}

}  // namespace

std::filesystem::path serverFilePath(const std::filesystem::path& world) {
    std::filesystem::path path = world;
    return path.replace_extension(".server.sqlite");
}

base::Result<std::unique_ptr<ServerFile>> ServerFile::open(const std::filesystem::path& path,
                                                           const world::BlockRegistry& blocks) {
    auto lock = store::FileLock::acquire(path, store::FileLock::Kind::Exclusive);
    if (!lock) return tl::unexpected(lock.error());
    auto writer = store::Database::open(path, store::OpenMode::Create);
    if (!writer) return tl::unexpected(writer.error());
    if (auto done = writer->execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL"); !done)
        return tl::unexpected(done.error());
    if (auto done = prepareTables(*writer); !done) return tl::unexpected(done.error());
    auto ids = mapBlocks(*writer, blocks);
    if (!ids) return tl::unexpected(ids.error());
    auto reader = store::Database::open(path, store::OpenMode::ReadOnly);
    if (!reader) return tl::unexpected(reader.error());
    return std::unique_ptr<ServerFile>(
        new ServerFile(Parts{std::move(*lock), std::move(*writer), std::move(*reader), std::move(*ids)}));
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
    auto transaction = store::Transaction::begin(writer_);
    if (!transaction) return tl::unexpected(transaction.error());
    for (const Write& write : writes)
        if (auto done = write(writer_); !done) return done;
    return transaction->commit();
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
