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

// Text that stays where it is for the life of the program: a connection prepares it once.
struct Statement {
    const char* sql;
};

struct Command {
    const Statement* statement;
    Parameters parameters = {};
};

// What a statement gave. Columns count from 0; a value of another type than asked for reads as 0 or empty.
class Rows {
  public:
    Rows() = default;
    explicit Rows(pg_result* result);
    int count() const;
    std::int64_t affected() const;  // rows that were inserted, changed or deleted
    bool isNull(int row, int column) const;
    std::int64_t number(int row, int column) const;  // of 2, 4 or 8 bytes; of a boolean 0 or 1
    std::string_view text(int row, int column) const;
    ByteView bytes(int row, int column) const;

  private:
    struct Free {
        void operator()(pg_result* result) const;
    };
    std::unique_ptr<pg_result, Free> result_;
};

// A message of NOTIFY.
struct Notification {
    std::string channel, payload;
};

class Connection {
  public:
    // Sets what all connections have: the schema as the only place of tables, UTF-8, durable commits.
    // NotFound where there is no such host or database, Io where no server answers, Refused where the
    // password is wrong.
    [[nodiscard]] static base::Result<Connection> open(const Address& address);

    [[nodiscard]] base::Result<Rows> run(const Statement& statement, const Parameters& parameters = {});
    // All in one round trip (pipeline mode); outside of a transaction as one of their own: all or nothing.
    [[nodiscard]] base::Result<std::vector<Rows>> runAll(std::span<const Command> commands);
    // The same where nobody asks for the rows.
    [[nodiscard]] base::Result<void> change(const Statement& statement, const Parameters& parameters = {});
    [[nodiscard]] base::Result<void> changeAll(std::span<const Command> commands);
    // One statement or several without parameters, as text.
    [[nodiscard]] base::Result<void> execute(const std::string& sql);

    // A name as SQL has it, quoted.
    std::string quoted(std::string_view name) const;

    // False: it is broken, and a new one is needed.
    bool isUsable() const;
    const std::string& shown() const { return shown_; }
    int socket() const;
    // What came of NOTIFY since the last call, without waiting. Empty and not isUsable() where it broke.
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

// Runs `action`, which gives a base::Result, in a transaction, which is undone where it fails.
template <class Do>
[[nodiscard]] std::invoke_result_t<Do> inTransaction(Connection& connection, Do action) {
    if (auto begun = connection.execute("BEGIN"); !begun) return tl::unexpected(begun.error());
    auto done = action();
    if (!done) {
        if (connection.isUsable()) (void)connection.execute("ROLLBACK");
        return done;
    }
    if (auto committed = connection.execute("COMMIT"); !committed) return tl::unexpected(committed.error());
    return done;
}

// Whether it makes sense to try again with a new connection: the server restarts, or the network broke.
bool isPassing(const base::Error& error);

}  // namespace terrane::store_postgres
