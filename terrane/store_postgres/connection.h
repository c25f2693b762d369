// A connection to PostgreSQL: statements with binary parameters, each prepared once, sent one by one or many
// in one round trip. Used by one thread at a time. Errors are one line that names the database, without a
// password.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/chunks/bytes.h"
#include "terrane/store_postgres/address.h"

struct pg_conn;
struct pg_result;

namespace terrane::store_postgres {

// Parameters of statements in PostgreSQL's binary formats. Plain values; any thread.
using store::Bytes;
using store::ByteView;

// Values of $1, $2, … in binary format.
class Parameters {
  public:
    Parameters& number(std::int64_t value);   // bigint
    Parameters& integer(std::int32_t value);  // integer
    Parameters& text(std::string_view value);
    Parameters& bytes(ByteView value);  // copied
    // One-dimensional arrays.
    Parameters& numbers(std::span<const std::int64_t> values);  // bigint[]
    Parameters& smallNumbers(std::span<const std::int16_t> values);
    Parameters& texts(std::span<const std::string> values);
    Parameters& byteStrings(std::span<const Bytes> values);  // bytea[]

  private:
    friend class Connection;
    void add(std::uint32_t type, std::string bytes);
    std::vector<std::uint32_t> types_;
    std::vector<std::string> values_;
};

// SQL with static storage duration and a stable address: a connection prepares each statement once.
struct Statement {
    const char* sql;
};

struct Command {
    const Statement* statement;
    Parameters parameters = {};
};

// Result of a statement. Columns count from 0. NULL reads as 0 or empty; types are not checked.
class Rows {
  public:
    Rows() = default;
    explicit Rows(pg_result* result);
    int count() const;
    std::int64_t affected() const;  // inserted, changed or deleted rows
    bool isNull(int row, int column) const;
    std::int64_t number(int row, int column) const;  // of 2, 4 or 8 bytes; a boolean is 0 or 1
    std::string_view text(int row, int column) const;
    ByteView bytes(int row, int column) const;

  private:
    struct Free {
        void operator()(pg_result* result) const;
    };
    std::unique_ptr<pg_result, Free> result_;
};

// A message sent by NOTIFY.
struct Notification {
    std::string channel, payload;
};

class Connection {
  public:
    // Opens a connection that only looks up tables in the schema, uses UTF-8 and commits durably. NotFound if
    // there is no such host or database, Io if no server answers, Refused if the password is wrong.
    [[nodiscard]] static base::Result<Connection> open(const Address& address);

    [[nodiscard]] base::Result<Rows> run(const Statement& statement, const Parameters& parameters = {});
    // Runs all in one round trip (pipeline mode); outside of a transaction all or nothing.
    [[nodiscard]] base::Result<std::vector<Rows>> runAll(std::span<const Command> commands);
    // The same without results.
    [[nodiscard]] base::Result<void> change(const Statement& statement, const Parameters& parameters = {});
    [[nodiscard]] base::Result<void> changeAll(std::span<const Command> commands);
    // Runs one or more statements without parameters, as text.
    [[nodiscard]] base::Result<void> execute(const std::string& sql);

    // A quoted SQL identifier.
    std::string quoted(std::string_view name) const;

    // False if the connection is broken and must be replaced.
    bool isUsable() const;
    const std::string& shown() const { return shown_; }
    int socket() const;
    // Notifications since the last call, without waiting. If the connection broke: empty, and not isUsable().
    std::vector<Notification> notifications();

  private:
    struct Close {
        void operator()(pg_conn* connection) const;
    };
    explicit Connection(pg_conn* connection, std::string shown);
    base::Error errorOf(const pg_result* result) const;
    base::Error failureOf(const pg_result* result);
    std::string nameOf(const Statement& statement) const;
    struct Queued {
        const Statement* statement;
        const Parameters* parameters;
    };
    base::Result<std::vector<Rows>> runQueued(std::span<const Queued> queue);
    bool send(const Queued& queued, std::vector<const Statement*>& prepares);
    base::Result<void> collect(std::vector<Rows>& rows);

    std::unique_ptr<pg_conn, Close> connection_;
    std::string shown_;
    std::set<const Statement*> prepared_;
};

// Runs `action`, which returns a base::Result, in a transaction; rolls back if it fails.
template <class Do>
[[nodiscard]] std::invoke_result_t<Do> inTransaction(Connection& connection, Do action) {
    TERRANE_TRY(connection.execute("BEGIN"));
    auto done = action();
    if (!done) {
        if (connection.isUsable()) (void)connection.execute("ROLLBACK");
        return done;
    }
    TERRANE_TRY(connection.execute("COMMIT"));
    return done;
}

// Whether a retry with a new connection makes sense: the server restarts, or the network broke.
bool isPassing(const base::Error& error);

// A pool of connections to one database for many threads. Operations that fail because the server restarts or
// the network breaks are retried with growing pauses.
// Pauses between attempts, which double, and the total time of attempts: `total` for writing, which a queue
// retries later, `reading` for reads, whose result is needed now.
struct RetryTimes {
    std::chrono::milliseconds first{50}, longest{2000}, total{30000}, reading = total;
};

class ConnectionPool {
  public:
    explicit ConnectionPool(Address address, RetryTimes times = {})
        : address_(std::move(address)), times_(times) {}

    const Address& address() const { return address_; }

    // Runs `use`, which reads, with its own connection, again while isPassing(). Any thread.
    template <class T>
    [[nodiscard]] base::Result<T> run(const std::function<base::Result<T>(Connection&)>& use) {
        return retryFor<T>(times_.reading, [&]() -> base::Result<T> {
            auto connection = TERRANE_TRY(take());
            auto result = use(connection);
            giveBack(std::move(connection));
            return result;
        });
    }

    // Retries an attempt to write, which has its own connection.
    template <class T>
    [[nodiscard]] base::Result<T> retry(const std::function<base::Result<T>()>& attempt) {
        return retryFor<T>(times_.total, attempt);
    }

  private:
    template <class T>
    base::Result<T> retryFor(std::chrono::milliseconds total,
                             const std::function<base::Result<T>()>& attempt) {
        const auto end = std::chrono::steady_clock::now() + total;
        for (auto pause = times_.first;; pause = std::min(2 * pause, times_.longest)) {
            auto result = attempt();
            if (result || !isPassing(result.error()) || std::chrono::steady_clock::now() + pause > end)
                return result;
            std::this_thread::sleep_for(pause);
        }
    }

    base::Result<Connection> take();
    void giveBack(Connection connection);  // a broken one drops the idle ones, which are as old

    Address address_;
    RetryTimes times_;
    std::mutex mutex_;
    std::vector<Connection> idle_;
};

}  // namespace terrane::store_postgres
