// A connection to PostgreSQL: statements with binary parameters, each prepared once, sent one by one or many
// in one round trip. Used by one thread at a time. Errors are one line that names the database, without a
// password.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/store/bytes.h"
#include "terrane/store_postgres/address.h"
#include "terrane/store_postgres/parameters.h"

struct pg_conn;
struct pg_result;

namespace terrane::store_postgres {

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

}  // namespace terrane::store_postgres
