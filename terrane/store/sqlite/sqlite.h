// RAII wrappers of SQLite's connections and statements. Errors read "path: what is wrong". A connection and
// its statements are used by one thread at a time, and trust nothing in the file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "terrane/base/platform.h"
#include "terrane/base/result.h"
#include "terrane/store/chunks/bytes.h"

struct sqlite3;
struct sqlite3_stmt;

namespace terrane::store {

// Restricts a SQLite connection to an untrusted file: a save cannot contain code (triggers, views, functions
// in its schema), or values and statements larger than saves have. sqlite.cpp uses it. Longer texts and blobs
// are not read: kMaxChunkBytes (64 MiB) before compression, plus the overhead of a zstd frame.
constexpr int kMaxValueBytes = (64 << 20) + (1 << 20);

// Restricts the connection; call it before anything is read.
void guardConnection(sqlite3* database);

// Stops statements that take too many steps while this exists: SQLite then returns SQLITE_INTERRUPT. For
// statements whose duration depends on a damaged file, such as reading the list of its tables.
class StepLimit {
  public:
    StepLimit(sqlite3* database, int thousands);  // limit in 1,000 VM steps, which take about 0.1 ms
    ~StepLimit();
    StepLimit(const StepLimit&) = delete;
    StepLimit& operator=(const StepLimit&) = delete;

  private:
    sqlite3* database_;
    int left_;
};

// The actual type of a value, which in an untrusted file may differ from the schema.
enum class ColumnType : std::uint8_t { Integer, Real, Text, Blob, Null };

class Statement {
  public:
    // Parameters count from 1. Blobs and texts are copied; if memory is short, the next step() fails.
    void bind(int parameter, std::int64_t value);
    void bind(int parameter, std::string_view text);
    void bind(int parameter, ByteView blob);

    // Steps to the next row. Returns true if there is a row to read, false at the end.
    [[nodiscard]] base::Result<bool> step();
    // Runs to the end, then resets.
    [[nodiscard]] base::Result<void> run();
    void reset();  // ready to be bound and stepped again; ends reading

    // The functions below return values of the row; columns count from 0. Views are valid until the next step
    // or reset.
    ColumnType type(int column) const;  // call first: the functions below change the type
    std::int64_t number(int column) const;
    std::string_view text(int column) const;
    ByteView blob(int column) const;

  private:
    friend class Database;
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const;
    };
    Statement(sqlite3_stmt* statement, const std::string* path) : statement_(statement), path_(path) {}
    void noteBound(int code);

    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
    bool isUnbound_ = false;   // a parameter could not be bound for lack of memory
    const std::string* path_;  // the database's
};

// Resets a statement at the end of a scope, also after an exception: a statement that is still reading cannot
// be bound again.
class ResetGuard {
  public:
    explicit ResetGuard(Statement& statement) : statement_(statement) {}
    ~ResetGuard() { statement_.reset(); }
    ResetGuard(const ResetGuard&) = delete;
    ResetGuard& operator=(const ResetGuard&) = delete;

  private:
    Statement& statement_;
};

enum class OpenMode {
    Create,     // created if missing
    ReadWrite,  // must exist
    ReadOnly,   // others may write
    Immutable,  // nobody writes; creates no files beside it
};

// Called while a database is copied, with the fraction done; false cancels the copy.
using CopyProgress = std::function<bool(double share)>;

// Writes a copy of a database into a new file, as of the moment at which it was begun, while others write. It
// is called once, on any thread, while the database's owner exists; it blocks.
using WriteCopy =
    std::function<base::Result<void>(const std::filesystem::path& target, const CopyProgress& progress)>;

class Database {
  public:
    [[nodiscard]] static base::Result<Database> open(const std::filesystem::path& path, OpenMode mode);

    // Runs statements that return no rows; several are separated by semicolons.
    [[nodiscard]] base::Result<void> execute(const std::string& sql);
    // Compiles a statement, which must not outlive the database.
    [[nodiscard]] base::Result<Statement> prepare(std::string_view sql);
    // Returns the first column of the first row; no value if there is no row.
    [[nodiscard]] base::Result<std::optional<std::int64_t>> queryNumber(std::string_view sql);
    // Copies everything into a new file, also while others read and write. A failed copy is removed.
    [[nodiscard]] base::Result<void> backUpTo(const std::filesystem::path& target,
                                              const CopyProgress& progress = {});

    const std::string& path() const { return *path_; }

  private:
    friend class Transaction;
    struct Close {
        void operator()(sqlite3* database) const;
    };
    void rollBack() noexcept;
    base::Result<void> loadSchema();
    base::Result<void> copyTo(const std::filesystem::path& target, const CopyProgress& progress);
    explicit Database(std::string path) : path_(std::make_unique<std::string>(std::move(path))) {}

    std::unique_ptr<std::string> path_;  // statements point to it
    std::unique_ptr<sqlite3, Close> database_;
};

// Calls visit(const Statement&) for each row of a query, until visit() returns an error.
template <class Visit>
[[nodiscard]] base::Result<void> forEachRow(Database& database, std::string_view sql, Visit visit) {
    auto select = TERRANE_TRY(database.prepare(sql));
    while (true) {
        const auto row = TERRANE_TRY(select.step());
        if (!row) return {};
        if (base::Result<void> visited = visit(std::as_const(select)); !visited) return visited;
    }
}

// A transaction that is rolled back unless committed. A connection has one at a time.
class Transaction {
  public:
    [[nodiscard]] static base::Result<Transaction> begin(Database& database);
    ~Transaction();
    Transaction(Transaction&& other) noexcept : database_(std::exchange(other.database_, nullptr)) {}
    Transaction& operator=(Transaction&&) = delete;

    [[nodiscard]] base::Result<void> commit();

  private:
    explicit Transaction(Database& database) : database_(&database) {}
    Database* database_;  // null: nothing to roll back
};

// The identities of an open database and its log. A writing connection checks with it that the files are
// still at their paths: data written into a deleted or replaced file is lost.
class OpenFiles {
  public:
    // `path`: an open database whose log exists.
    explicit OpenFiles(const std::filesystem::path& path);

    // Checks the files. Returns NotFound, with advice, if a file was deleted, moved or replaced. Succeeds
    // again once it is back.
    [[nodiscard]] base::Result<void> check() const;

  private:
    struct Opened {
        std::filesystem::path path;
        std::optional<base::platform::FileIdentity> identity;  // none: there is no file
    };
    std::array<Opened, 2> files_;
};

}  // namespace terrane::store
