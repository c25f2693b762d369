#include "terrane/store_postgres/connection.h"

#include <libpq-fe.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

namespace terrane::store_postgres {

namespace {

// Types of parameters (pg_type.dat of PostgreSQL); they never change.
enum : std::uint32_t {
    kBytea = 17,
    kInt8 = 20,
    kInt2 = 21,
    kInt4 = 23,
    kText = 25,
    kByteaArray = 1001,
    kInt2Array = 1005,
    kTextArray = 1009,
    kInt8Array = 1016,
};

// PostgreSQL's binary formats are big-endian.
template <class T>
std::string bigEndian(T value) {
    std::string bytes(sizeof value, '\0');
    for (std::size_t k = 0; k < sizeof value; ++k)
        bytes[k] = static_cast<char>(static_cast<std::uint64_t>(value) >> 8 * (sizeof value - 1 - k));
    return bytes;
}

// Header of a one-dimensional array without NULLs: dimensions, flags, type, then length and lower bound.
std::string arrayHead(std::uint32_t type, std::size_t count) {
    return bigEndian(std::int32_t{1}) + bigEndian(std::int32_t{0}) + bigEndian(type) +
           bigEndian(static_cast<std::int32_t>(count)) + bigEndian(std::int32_t{1});
}

template <class T>
std::string numberArray(std::uint32_t type, std::span<const T> values) {
    std::string bytes = arrayHead(type, values.size());
    for (const T value : values) bytes += bigEndian(std::int32_t{sizeof(T)}) + bigEndian(value);
    return bytes;
}

std::string_view viewOf(ByteView bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

Parameters& Parameters::number(std::int64_t value) {
    add(kInt8, bigEndian(value));
    return *this;
}
Parameters& Parameters::integer(std::int32_t value) {
    add(kInt4, bigEndian(value));
    return *this;
}
Parameters& Parameters::text(std::string_view value) {
    add(kText, std::string(value));
    return *this;
}
Parameters& Parameters::bytes(ByteView value) {
    add(kBytea, std::string(viewOf(value)));
    return *this;
}
Parameters& Parameters::numbers(std::span<const std::int64_t> values) {
    add(kInt8Array, numberArray(kInt8, values));
    return *this;
}
Parameters& Parameters::smallNumbers(std::span<const std::int16_t> values) {
    add(kInt2Array, numberArray(kInt2, values));
    return *this;
}
Parameters& Parameters::texts(std::span<const std::string> values) {
    std::string bytes = arrayHead(kText, values.size());
    for (const std::string& value : values)
        bytes += bigEndian(static_cast<std::int32_t>(value.size())) + value;
    add(kTextArray, std::move(bytes));
    return *this;
}
Parameters& Parameters::byteStrings(std::span<const Bytes> values) {
    std::size_t size = 0;
    for (const Bytes& value : values) size += value.size() + 4;
    std::string bytes = arrayHead(kBytea, values.size());
    bytes.reserve(bytes.size() + size);
    for (const Bytes& value : values)
        bytes.append(bigEndian(static_cast<std::int32_t>(value.size()))).append(viewOf(value));
    add(kByteaArray, std::move(bytes));
    return *this;
}
void Parameters::add(std::uint32_t type, std::string bytes) {
    types_.push_back(type);
    values_.push_back(std::move(bytes));
}

namespace {

using base::ErrorCode;

// Defaults that a URL can override. A network without traffic for half a minute counts as broken.
struct Setting {
    const char *name, *value;
};
constexpr Setting kDefaults[] = {
    {"fallback_application_name", "terrane"},
    {"connect_timeout", "10"},
    {"keepalives_idle", "10"},
    {"keepalives_interval", "5"},
    {"keepalives_count", "4"},
    {"tcp_user_timeout", "30000"},
};

// PostgreSQL's binary formats are big-endian.
std::int64_t signedNumber(const char* bytes, int size) {
    if (size != 1 && size != 2 && size != 4 && size != 8) return 0;
    std::uint64_t value = bytes[0] < 0 ? ~std::uint64_t{0} : 0;
    for (int k = 0; k < size; ++k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
    return std::bit_cast<std::int64_t>(value);
}

// libpq reports one line per address of a server: selects that of a server that answered, or else the first.
std::string_view lineOfServer(std::string_view text) {
    const std::size_t fatal = text.find("FATAL:");
    if (fatal == std::string_view::npos) return text;
    const std::size_t end = text.rfind('\n', fatal);
    return end == std::string_view::npos ? text : text.substr(end + 1);
}

// The first line of libpq's message, without "ERROR:".
std::string firstLine(std::string_view text) {
    text = text.substr(0, text.find('\n'));
    for (const std::string_view word : {"ERROR:", "FATAL:", "PANIC:"})
        if (const std::size_t at = text.find(word); at != std::string_view::npos)
            text = text.substr(at + word.size());
    while (text.starts_with(' ')) text.remove_prefix(1);
    return std::string(text);
}

constexpr std::string_view kDiskFull = "53100", kReadOnly = "25006";

// Maps SQLSTATE (PostgreSQL's documentation, appendix A).
ErrorCode codeOf(std::string_view state) {
    const std::string_view category = state.substr(0, 2);
    if (category == "08" || category == "57" || category == "40" || state == "53300") return ErrorCode::Io;
    if (category == "28" || state == "42501" || state == "25006") return ErrorCode::Refused;
    if (category == "53" || category == "54") return ErrorCode::OutOfResources;
    if (category == "58" || category == "XX") return ErrorCode::Damaged;
    if (state == "3D000" || state == "3F000") return ErrorCode::NotFound;
    if (category == "55") return ErrorCode::Busy;
    return ErrorCode::Failed;
}

// Errors while connecting have no SQLSTATE. Unknown messages of a server count as Io, which is retried.
ErrorCode codeOfConnecting(std::string_view message) {
    const auto says = [&](std::string_view words) { return message.find(words) != std::string_view::npos; };
    if (says("password authentication failed") || says("no password supplied") || says("pg_hba.conf") ||
        says("permission denied") || says("is not permitted to log in") ||
        (says("role \"") && says("does not exist")))
        return ErrorCode::Refused;
    if (says("database \"") && says("does not exist")) return ErrorCode::NotFound;
    if (says("could not translate host name") && !says("Temporary failure")) return ErrorCode::NotFound;
    return ErrorCode::Io;
}

// Drops notices, which libpq would print.
void ignoreNotice(void*, const PGresult*) {}

// Also makes the server end stalled or vanished connections, since others wait for their locks.
constexpr Statement kSetUp = {
    "SELECT set_config('search_path', $1, false), set_config('client_min_messages', 'warning', false), "
    "set_config('synchronous_commit', CASE WHEN current_setting('synchronous_commit') = 'off' THEN 'on' "
    "ELSE current_setting('synchronous_commit') END, false), current_setting('server_encoding'), "
    "set_config('idle_in_transaction_session_timeout', '60s', false), set_config('tcp_keepalives_idle', "
    "'10', false), "
    "set_config('tcp_keepalives_interval', '5', false), set_config('tcp_keepalives_count', '4', false), "
    "set_config('tcp_user_timeout', '30000', false)"};

}  // namespace

Rows::Rows(pg_result* result) : result_(result) {}
void Rows::Free::operator()(pg_result* result) const {
    PQclear(result);
}
int Rows::count() const {
    return result_ ? PQntuples(result_.get()) : 0;
}
std::int64_t Rows::affected() const {
    return result_ ? std::atoll(PQcmdTuples(result_.get())) : 0;
}
bool Rows::isNull(int row, int column) const {
    return PQgetisnull(result_.get(), row, column) != 0;
}
std::int64_t Rows::number(int row, int column) const {
    return signedNumber(PQgetvalue(result_.get(), row, column), PQgetlength(result_.get(), row, column));
}
std::string_view Rows::text(int row, int column) const {
    return {PQgetvalue(result_.get(), row, column),
            static_cast<std::size_t>(PQgetlength(result_.get(), row, column))};
}
ByteView Rows::bytes(int row, int column) const {
    return std::as_bytes(std::span(text(row, column)));
}

void Connection::Close::operator()(pg_conn* connection) const {
    PQfinish(connection);
}

Connection::Connection(pg_conn* connection, std::string shown)
    : connection_(connection), shown_(std::move(shown)) {}

base::Result<Connection> Connection::open(const Address& address) {
    std::vector<const char*> keywords, values;
    for (const Setting& setting : kDefaults) {
        keywords.push_back(setting.name);
        values.push_back(setting.value);
    }
    keywords.insert(keywords.end(), {"dbname", nullptr});
    values.insert(values.end(), {address.url.c_str(), nullptr});
    Connection connection(PQconnectdbParams(keywords.data(), values.data(), 1), address.shown);
    PGconn* raw = connection.connection_.get();
    if (!raw) return base::fail(ErrorCode::OutOfResources, "{}: no memory", address.shown);
    if (PQstatus(raw) != CONNECTION_OK) {
        const std::string message = firstLine(lineOfServer(PQerrorMessage(raw)));
        const ErrorCode code =
            PQconnectionNeedsPassword(raw) ? ErrorCode::Refused : codeOfConnecting(message);
        return base::fail(code, "{}: cannot be reached: {}", address.shown, message);
    }
    PQsetNoticeReceiver(raw, ignoreNotice, nullptr);
    if (PQsetClientEncoding(raw, "UTF8") != 0) return tl::unexpected(connection.errorOf(nullptr));
    const std::string path = connection.quoted(address.schema);
    auto rows = TERRANE_TRY(connection.run(kSetUp, Parameters().text(path)));
    if (rows.text(0, 3) != "UTF8")
        return base::fail(ErrorCode::Incompatible, "{}: its encoding is {}, expected UTF8", address.shown,
                          rows.text(0, 3));
    return connection;
}

base::Error Connection::errorOf(const pg_result* result) const {
    const char* stateText = result ? PQresultErrorField(result, PG_DIAG_SQLSTATE) : nullptr;
    const std::string_view state = stateText ? stateText : "";
    const char* primary = result ? PQresultErrorField(result, PG_DIAG_MESSAGE_PRIMARY) : nullptr;
    const std::string message = firstLine(primary ? primary : PQerrorMessage(connection_.get()));
    const ErrorCode own = isUsable() ? ErrorCode::Failed : ErrorCode::Io;
    const ErrorCode code = state.empty() ? own : codeOf(state);
    if (state == kDiskFull)
        return {code, fmt::format("{}: the disk of the server is full: {}", shown_, message)};
    return {code, fmt::format("{}: {}", shown_, message.empty() ? "the connection is lost" : message)};
}

// An error without SQLSTATE comes from libpq. It can precede the broken state of the connection, if writing
// failed and the server's last message is still unread.
base::Error Connection::failureOf(const pg_result* result) {
    base::Error error = errorOf(result);
    const char* state = PQresultErrorField(result, PG_DIAG_SQLSTATE);
    // A read-only server: another one may have become the primary.
    if (state && state == kReadOnly) connection_ = nullptr;
    if (state) return error;
    connection_ = nullptr;
    return {ErrorCode::Io, std::move(error.message)};
}

// Name of a prepared statement, valid for the connection's lifetime.
std::string Connection::nameOf(const Statement& statement) const {
    return fmt::format("s{:x}", reinterpret_cast<std::uintptr_t>(&statement));
}

bool Connection::isUsable() const {
    return connection_ && PQstatus(connection_.get()) == CONNECTION_OK;
}

// Queues a statement, and before it its preparation if needed. Records the kind of each result in `prepares`.
bool Connection::send(const Queued& queued, std::vector<const Statement*>& prepares) {
    PGconn* raw = connection_.get();
    const Statement* statement = queued.statement;
    const Parameters& parameters = *queued.parameters;
    const auto count = static_cast<int>(parameters.values_.size());
    const std::string name = nameOf(*statement);
    if (!prepared_.contains(statement) && std::ranges::count(prepares, statement) == 0) {
        const std::vector<Oid> types(parameters.types_.begin(), parameters.types_.end());
        if (!PQsendPrepare(raw, name.c_str(), statement->sql, count, types.data())) return false;
        prepares.push_back(statement);
    }
    std::vector<const char*> values;
    std::vector<int> lengths;
    for (const std::string& value : parameters.values_) {
        values.push_back(value.data());
        lengths.push_back(static_cast<int>(value.size()));
    }
    const std::vector<int> formats(parameters.values_.size(), 1);  // binary
    prepares.push_back(nullptr);
    return PQsendQueryPrepared(raw, name.c_str(), count, values.data(), lengths.data(), formats.data(), 1) !=
           0;
}

// Appends the results of a pipeline up to its end, or to the first error.
base::Result<void> Connection::collect(std::vector<Rows>& rows) {
    PGconn* raw = connection_.get();
    base::Result<void> done;
    int nothing = 0;  // consecutive nulls: one between statements, endless if broken
    for (bool isEnd = false; !isEnd && isUsable() && nothing < 2;) {
        PGresult* result = PQgetResult(raw);
        nothing = result ? 0 : nothing + 1;
        if (!result) continue;
        Rows taken(result);
        switch (PQresultStatus(result)) {
            case PGRES_PIPELINE_SYNC:
                isEnd = true;
                break;
            case PGRES_PIPELINE_ABORTED:
                break;
            case PGRES_TUPLES_OK:
            case PGRES_COMMAND_OK:
                if (done) rows.push_back(std::move(taken));
                break;
            default:
                if (done) done = tl::unexpected(failureOf(result));
        }
    }
    if (nothing == 2) connection_ = nullptr;
    if (done && !isUsable()) done = base::fail(ErrorCode::Io, "{}: the connection is lost", shown_);
    return done;
}

base::Result<std::vector<Rows>> Connection::runQueued(std::span<const Queued> queue) {
    PGconn* raw = connection_.get();
    if (!isUsable()) return base::fail(ErrorCode::Io, "{}: the connection is lost", shown_);
    if (!PQenterPipelineMode(raw)) return tl::unexpected(errorOf(nullptr));
    std::vector<const Statement*> prepares;  // for each result; null: result of a query
    bool isSent = true;
    for (const Queued& queued : queue) isSent = isSent && send(queued, prepares);
    isSent = isSent && PQpipelineSync(raw) != 0;
    if (!isSent) {
        base::Error error = errorOf(nullptr);
        connection_ = nullptr;  // a partial send cannot be undone
        return tl::unexpected(std::move(error));
    }
    std::vector<Rows> results, answers;
    const auto done = collect(results);
    if (isUsable()) PQexitPipelineMode(raw);
    // Prepared statements survive a failed transaction.
    for (std::size_t k = 0; k < std::min(results.size(), prepares.size()); ++k) {
        if (prepares[k])
            prepared_.insert(prepares[k]);
        else
            answers.push_back(std::move(results[k]));
    }
    if (!done) return tl::unexpected(done.error());
    if (answers.size() == queue.size()) return answers;
    return base::fail(ErrorCode::Io, "{}: it gave {} answers to {} statements", shown_, answers.size(),
                      queue.size());
}

base::Result<std::vector<Rows>> Connection::runAll(std::span<const Command> commands) {
    std::vector<Queued> queue;
    for (const Command& command : commands) queue.push_back({command.statement, &command.parameters});
    return runQueued(queue);
}

base::Result<Rows> Connection::run(const Statement& statement, const Parameters& parameters) {
    const Queued queued{&statement, &parameters};
    auto rows = TERRANE_TRY(runQueued(std::span(&queued, 1)));
    return std::move(rows.front());
}

base::Result<void> Connection::change(const Statement& statement, const Parameters& parameters) {
    return run(statement, parameters).map([](const Rows&) {});
}

base::Result<void> Connection::changeAll(std::span<const Command> commands) {
    return runAll(commands).map([](const std::vector<Rows>&) {});
}

base::Result<void> Connection::execute(const std::string& sql) {
    if (!isUsable()) return base::fail(ErrorCode::Io, "{}: the connection is lost", shown_);
    PGresult* result = PQexec(connection_.get(), sql.c_str());
    const Rows rows(result);
    const ExecStatusType status = PQresultStatus(result);
    if (status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK || status == PGRES_EMPTY_QUERY) return {};
    return tl::unexpected(failureOf(result));
}

std::string Connection::quoted(std::string_view name) const {
    std::string text = "\"";
    for (const char c : name) {
        if (c == '"') text += '"';
        text += c;
    }
    return text + '"';
}

int Connection::socket() const {
    return connection_ ? PQsocket(connection_.get()) : -1;
}

std::vector<Notification> Connection::notifications() {
    std::vector<Notification> found;
    if (!connection_) return found;
    if (!PQconsumeInput(connection_.get())) return found;
    while (PGnotify* notify = PQnotifies(connection_.get())) {
        found.push_back({notify->relname, notify->extra});
        PQfreemem(notify);
    }
    return found;
}

bool isPassing(const base::Error& error) {
    return error.code == ErrorCode::Io;
}

base::Result<Connection> ConnectionPool::take() {
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            Connection connection = std::move(idle_.back());
            idle_.pop_back();
            return connection;
        }
    }
    return Connection::open(address_);
}

void ConnectionPool::giveBack(Connection connection) {
    const std::lock_guard lock(mutex_);
    if (connection.isUsable())
        idle_.push_back(std::move(connection));
    else
        idle_.clear();
}

}  // namespace terrane::store_postgres
