#include "terrane/store/sqlite/sqlite.h"

#include <sqlite3.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace terrane::store {

void guardConnection(sqlite3* database) {
    constexpr std::pair<int, int> kSettings[] = {
        {SQLITE_DBCONFIG_DEFENSIVE, 1},      {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
        {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0}, {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
        {SQLITE_DBCONFIG_DQS_DDL, 0},        {SQLITE_DBCONFIG_DQS_DML, 0},
    };
    for (const auto& [setting, value] : kSettings) sqlite3_db_config(database, setting, value, nullptr);
    // Maximum of what saves and the statements of this module need, with a margin. 0 would mean no limit for
    // some of them.
    constexpr std::pair<int, int> kLimits[] = {
        {SQLITE_LIMIT_LENGTH, kMaxValueBytes},
        {SQLITE_LIMIT_SQL_LENGTH, 16384},
        {SQLITE_LIMIT_COLUMN, 32},
        {SQLITE_LIMIT_EXPR_DEPTH, 32},
        {SQLITE_LIMIT_COMPOUND_SELECT, 2},
        {SQLITE_LIMIT_VDBE_OP, 25000},
        {SQLITE_LIMIT_FUNCTION_ARG, 8},
        {SQLITE_LIMIT_ATTACHED, 0},
        {SQLITE_LIMIT_VARIABLE_NUMBER, 16},
        {SQLITE_LIMIT_TRIGGER_DEPTH, 1},
        {SQLITE_LIMIT_WORKER_THREADS, 0},
    };
    for (const auto& [limit, value] : kLimits) sqlite3_limit(database, limit, value);
}

StepLimit::StepLimit(sqlite3* database, int thousands) : database_(database), left_(thousands) {
    constexpr int kStepsBetweenCalls = 1000;
    const auto isOver = [](void* left) { return (*static_cast<int*>(left))-- <= 0 ? 1 : 0; };
    sqlite3_progress_handler(database_, kStepsBetweenCalls, isOver, &left_);
}

StepLimit::~StepLimit() {
    sqlite3_progress_handler(database_, 0, nullptr, nullptr);
}

namespace {

// Time that a statement waits for another connection. Terrane's own programs use the lock; after this time
// only a program without it, such as sqlite3, can still block.
constexpr int kBusyMilliseconds = 10000;

// Plain messages for errors that a user can act on; SQLite's messages for the rest. `systemError`: the number
// of the system's last one, or 0.
std::string describe(int code, const char* message, int systemError) {
    switch (code & 0xFF) {
        case SQLITE_FULL:
            return "the disk is full";
        case SQLITE_NOTADB:
            return "not a SQLite file";
        case SQLITE_CORRUPT:
            return fmt::format("damaged: {}", message);
        case SQLITE_TOOBIG:
            return fmt::format("damaged: a value is longer than {} bytes", kMaxValueBytes);
        case SQLITE_INTERRUPT:
            return "damaged: reading it does not end";
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return "in use by another program";
        case SQLITE_READONLY:
            return "cannot be written";
        case SQLITE_CANTOPEN:
            return "cannot be opened";
        case SQLITE_IOERR:
            // The index of the log is memory-mapped: an error there means that address space or memory is
            // short; SQLite does not say which.
            if (code == SQLITE_IOERR_SHMMAP || code == SQLITE_IOERR_NOMEM) return "out of memory";
            if (systemError != 0)
                return fmt::format("reading or writing failed: {}", base::systemReason(systemError));
            return fmt::format("reading or writing failed (SQLite code {})", code);
        default:
            return message;
    }
}

base::ErrorCode codeOf(int code) {
    switch (code & 0xFF) {
        case SQLITE_FULL:
        case SQLITE_NOMEM:
            return base::ErrorCode::OutOfResources;
        case SQLITE_NOTADB:
            return base::ErrorCode::Incompatible;
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return base::ErrorCode::Busy;
        case SQLITE_READONLY:
        case SQLITE_CANTOPEN:
        case SQLITE_IOERR:
            return base::ErrorCode::Io;
        case SQLITE_CORRUPT:
        case SQLITE_TOOBIG:
        case SQLITE_INTERRUPT:
            return base::ErrorCode::Damaged;
        default:
            return base::ErrorCode::Failed;
    }
}

tl::unexpected<base::Error> failure(const std::string& path, sqlite3* database) {
    const int code = sqlite3_extended_errcode(database);
    return base::fail(codeOf(code), "{}: {}", path,
                      describe(code, sqlite3_errmsg(database), sqlite3_system_errno(database)));
}

// "file:" and the path, with characters that are special in a URI escaped.
std::string uriOf(const std::filesystem::path& path, bool isImmutable) {
    std::string uri = path.is_absolute() ? "file://" : "file:";  // "//" starts an authority, which is empty
    const std::string text = path.generic_string();
    if (path.is_absolute() && !text.starts_with('/')) uri += '/';  // before a drive of Windows
    for (const char c : text) {
        if (c == '?' || c == '#' || c == '%') {
            uri += fmt::format("%{:02x}", static_cast<unsigned char>(c));
        } else {
            uri += c;
        }
    }
    return isImmutable ? uri + "?immutable=1" : uri;
}

int openFlags(OpenMode mode) {
    constexpr int kCommon = SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
    switch (mode) {
        case OpenMode::Create:
            return kCommon | SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
        case OpenMode::ReadWrite:
            return kCommon | SQLITE_OPEN_READWRITE;
        case OpenMode::ReadOnly:
        case OpenMode::Immutable:
            break;
    }
    return kCommon | SQLITE_OPEN_READONLY;
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
    sqlite3_finalize(statement);
}

// After a failure the previous value stays bound.
void Statement::noteBound(int code) {
    assert((code == SQLITE_OK || code == SQLITE_NOMEM) && "the statement has this parameter and was reset");
    if (code != SQLITE_OK) isUnbound_ = true;
}

void Statement::bind(int parameter, std::int64_t value) {
    noteBound(sqlite3_bind_int64(statement_.get(), parameter, value));
}

void Statement::bind(int parameter, std::string_view text) {
    noteBound(sqlite3_bind_text64(statement_.get(), parameter, text.data(), text.size(), SQLITE_TRANSIENT,
                                  SQLITE_UTF8));
}

void Statement::bind(int parameter, ByteView blob) {
    // A null pointer would bind NULL, which equals nothing.
    noteBound(blob.empty() ? sqlite3_bind_zeroblob(statement_.get(), parameter, 0)
                           : sqlite3_bind_blob64(statement_.get(), parameter, blob.data(), blob.size(),
                                                 SQLITE_TRANSIENT));
}

base::Result<bool> Statement::step() {
    if (isUnbound_) return base::fail(base::ErrorCode::OutOfResources, "{}: no memory", *path_);
    const int code = sqlite3_step(statement_.get());
    if (code == SQLITE_ROW) return true;
    if (code == SQLITE_DONE) return false;
    return failure(*path_, sqlite3_db_handle(statement_.get()));
}

base::Result<void> Statement::run() {
    const ResetGuard reset(*this);
    base::Result<bool> more = true;
    while (more && *more) more = step();
    if (!more) return tl::unexpected(more.error());
    return {};
}

void Statement::reset() {
    sqlite3_reset(statement_.get());
    isUnbound_ = false;
}

ColumnType Statement::type(int column) const {
    switch (sqlite3_column_type(statement_.get(), column)) {
        case SQLITE_INTEGER:
            return ColumnType::Integer;
        case SQLITE_FLOAT:
            return ColumnType::Real;
        case SQLITE_TEXT:
            return ColumnType::Text;
        case SQLITE_BLOB:
            return ColumnType::Blob;
        default:
            return ColumnType::Null;
    }
}

std::int64_t Statement::number(int column) const {
    return sqlite3_column_int64(statement_.get(), column);
}

std::string_view Statement::text(int column) const {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
    return {text ? text : "", static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

ByteView Statement::blob(int column) const {
    const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(statement_.get(), column));
    return {data, data ? static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)) : 0};
}

void Database::Close::operator()(sqlite3* database) const {
    [[maybe_unused]] const int code = sqlite3_close(database);
    assert(code == SQLITE_OK && "statements go before their database");
}

base::Result<Database> Database::open(const std::filesystem::path& path, OpenMode mode) {
    Database result(path.string());
    sqlite3* handle = nullptr;
    const std::string uri = uriOf(path, mode == OpenMode::Immutable);
    const int code = sqlite3_open_v2(uri.c_str(), &handle, openFlags(mode), nullptr);
    result.database_.reset(handle);
    if (code != SQLITE_OK) return failure(result.path(), handle);
    sqlite3_extended_result_codes(handle, 1);
    sqlite3_busy_timeout(handle, kBusyMilliseconds);
    guardConnection(handle);
    TERRANE_TRY(result.loadSchema());
    return result;
}

// The file itself sets the size of the cache, which could be all memory. 2 MB are enough.
base::Result<void> Database::loadSchema() {
    constexpr int kThousandSteps = 5;  // the schema of a save takes about 100 steps
    const StepLimit limit(database_.get(), kThousandSteps);
    return execute("PRAGMA cell_size_check = 1; PRAGMA mmap_size = 0; PRAGMA cache_size = -2000");
}

base::Result<void> Database::execute(const std::string& sql) {
    if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return {};
    return failure(path(), database_.get());
}

// Fails if an error, such as a full disk, already rolled back: then there is nothing left to do.
void Database::rollBack() noexcept {
    sqlite3_exec(database_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
}

base::Result<Statement> Database::prepare(std::string_view sql) {
    sqlite3_stmt* statement = nullptr;
    const int code = sqlite3_prepare_v3(database_.get(), sql.data(), static_cast<int>(sql.size()),
                                        SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
    if (code != SQLITE_OK) return failure(path(), database_.get());
    return Statement(statement, path_.get());
}

base::Result<std::optional<std::int64_t>> Database::queryNumber(std::string_view sql) {
    auto statement = TERRANE_TRY(prepare(sql));
    const auto row = TERRANE_TRY(statement.step());
    return row ? std::optional(statement.number(0)) : std::nullopt;
}

base::Result<void> Database::backUpTo(const std::filesystem::path& target, const CopyProgress& progress) {
    if (std::filesystem::exists(target))
        return base::fail(base::ErrorCode::BadInput, "{}: exists; a copy replaces no file", target.string());
    auto copied = copyTo(target, progress);
    if (!copied) {
        std::error_code ignored;
        std::filesystem::remove(target, ignored);
    }
    return copied;
}

base::Result<void> Database::copyTo(const std::filesystem::path& target, const CopyProgress& progress) {
    constexpr int kPagesAStep = 1024;  // 4 MiB
    auto copy = TERRANE_TRY(open(target, OpenMode::Create));
    sqlite3* to = copy.database_.get();
    sqlite3_backup* backup = sqlite3_backup_init(to, "main", database_.get(), "main");
    if (!backup) return failure(copy.path(), to);
    bool isWanted = true;
    while (isWanted && sqlite3_backup_step(backup, progress ? kPagesAStep : -1) == SQLITE_OK) {
        const int left = sqlite3_backup_remaining(backup), all = sqlite3_backup_pagecount(backup);
        isWanted = !progress || progress(1 - static_cast<double>(left) / std::max(all, 1));
    }
    // The result of finish() is that of the steps; the target has the reason.
    if (sqlite3_backup_finish(backup) != SQLITE_OK) return failure(copy.path(), to);
    if (!isWanted) return base::fail("{}: the copy was cancelled", copy.path());
    return {};
}

base::Result<Transaction> Transaction::begin(Database& database) {
    // Repeats a rollback that failed for lack of memory.
    if (sqlite3_get_autocommit(database.database_.get()) == 0) database.rollBack();
    TERRANE_TRY(database.execute("BEGIN IMMEDIATE"));
    return Transaction(database);
}

Transaction::~Transaction() {
    if (database_) database_->rollBack();
}

base::Result<void> Transaction::commit() {
    assert(database_ && "committed once");
    auto done = database_->execute("COMMIT");
    if (done) database_ = nullptr;
    return done;
}

namespace {

std::optional<base::platform::FileIdentity> fileIdentity(const std::filesystem::path& path) {
    const auto status = base::platform::statusOf(path, base::platform::Links::Follow);
    return status ? std::optional(status->identity) : std::nullopt;
}

}  // namespace

OpenFiles::OpenFiles(const std::filesystem::path& path) {
    const std::filesystem::path log = path.string() + "-wal";
    files_ = {Opened{path, fileIdentity(path)}, Opened{log, fileIdentity(log)}};
}

base::Result<void> OpenFiles::check() const {
    for (const Opened& opened : files_) {
        const auto now = fileIdentity(opened.path);
        if (now == opened.identity) continue;
        return base::fail(base::ErrorCode::NotFound,
                          "{}: {} while it was open; nothing is written until the file that was open is back",
                          opened.path.string(), now ? "replaced" : "deleted or moved");
    }
    return {};
}

}  // namespace terrane::store
