// libFuzzer: a save with changed rows and tables: valid for SQLite, with correct checksums of chunks. The
// input is a list of changes to smallSave() or tallSave().
#include <sqlite3.h>

#include <memory>

#include "terrane/store/chunks/chunk_key.h"
#include "tests/fuzz/fuzz_chunks.h"
#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/fuzz/fuzz_saves.h"

namespace {

using namespace terrane;
using fuzz::FuzzInput;

struct CloseDatabase {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct EndStatement {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, EndStatement>;

// Null for statements that SQLite refuses.
Statement prepare(sqlite3* database, const char* sql) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database, sql, -1, &statement, nullptr);
    return Statement(statement);
}

void run(const Statement& statement) {
    for (int steps = 0; statement && steps < 100 && sqlite3_step(statement.get()) == SQLITE_ROW;) ++steps;
}

// A value of any type.
void bindAny(const Statement& statement, int at, FuzzInput& input) {
    if (!statement) return;
    static constexpr std::uint8_t kSizes[] = {1, 2, 4, 8};
    switch (input.byte() % 6) {
        case 0:
            sqlite3_bind_null(statement.get(), at);
            return;
        case 1:
            sqlite3_bind_int64(statement.get(), at,
                               static_cast<std::int64_t>(input.number(input.oneOf(kSizes))));
            return;
        case 2:
            sqlite3_bind_double(statement.get(), at, static_cast<double>(input.number(8)) * 1e-3);
            return;
        case 3: {
            const std::string_view text = input.text();
            sqlite3_bind_text64(statement.get(), at, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
            return;
        }
        case 4: {
            const std::string_view bytes = input.text();
            sqlite3_bind_blob64(statement.get(), at, bytes.data(), bytes.size(), SQLITE_TRANSIENT);
            return;
        }
        default: {  // a number as text
            const std::string text = std::to_string(static_cast<std::int64_t>(input.number(8)));
            sqlite3_bind_text(statement.get(), at, text.c_str(), -1, SQLITE_TRANSIENT);
        }
    }
}

// Corrects the checksum of the last written row, which covers its key and origin.
void sealLastRow(sqlite3* database) {
    const Statement read =
        prepare(database, "SELECT key, origin, data FROM chunks WHERE key = last_insert_rowid()");
    if (!read || sqlite3_step(read.get()) != SQLITE_ROW) return;
    const auto* bytes = static_cast<const std::byte*>(sqlite3_column_blob(read.get(), 2));
    store::Bytes data(bytes, bytes + sqlite3_column_bytes(read.get(), 2));
    const std::int64_t key = sqlite3_column_int64(read.get(), 0),
                       origin = sqlite3_column_int64(read.get(), 1);
    if (data.size() < 13) return;
    store::sealChunk(data, store::checksumSeed(store::posOf(key), origin != 0));
    const Statement write = prepare(database, "UPDATE chunks SET data = ?1 WHERE key = ?2");
    if (!write) return;
    sqlite3_bind_blob64(write.get(), 1, data.data(), data.size(), SQLITE_TRANSIENT);
    sqlite3_bind_int64(write.get(), 2, key);
    run(write);
}

void changeChunk(sqlite3* database, FuzzInput& input, world::Heights heights) {
    static constexpr std::int64_t kKeys[] = {store::keyOf({0, 0}), store::keyOf({1, 0}),
                                             store::keyOf({-1, 5}), store::keyOf({0, -2, 1})};
    const Statement row =
        prepare(database, "INSERT OR REPLACE INTO chunks (key, origin, data) VALUES (?1, ?2, ?3)");
    if (!row) return;
    const bool isKnown = input.byte() % 2 == 0;
    if (isKnown) sqlite3_bind_int64(row.get(), 1, input.oneOf(kKeys));
    if (!isKnown) bindAny(row, 1, input);
    bindAny(row, 2, input);
    const std::uint8_t depth = input.byte();
    if (depth >= 250) {
        bindAny(row, 3, input);
    } else {
        const store::Bytes data = fuzz::chunkData(depth, input.bytes(input.number(2) % 2048), heights);
        sqlite3_bind_blob64(row.get(), 3, data.data(), data.size(), SQLITE_TRANSIENT);
    }
    run(row);
    if (depth % 3 != 0 && depth < 250) sealLastRow(database);
}

void changeSetting(sqlite3* database, FuzzInput& input) {
    static constexpr const char* kNames[] = {
        "seed", "generator", "generator_version", "tiles", "player", "time", "bottom", "top"};
    const Statement row = prepare(database, "INSERT OR REPLACE INTO settings VALUES (?1, ?2)");
    const std::uint8_t name = input.byte();
    if (name % 10 < std::size(kNames)) {
        if (row) sqlite3_bind_text(row.get(), 1, kNames[name % 10], -1, SQLITE_STATIC);
    } else {
        bindAny(row, 1, input);
    }
    bindAny(row, 2, input);
    run(row);
}

void changeRow(sqlite3* database, FuzzInput& input) {
    static constexpr const char* kStatements[] = {
        "INSERT OR REPLACE INTO blocks VALUES (?1, ?2)",
        "UPDATE blocks SET id = ?1 WHERE name = ?2",
        "UPDATE blocks SET name = ?2 WHERE id = ?1",
        "INSERT OR REPLACE INTO quarantine VALUES (?1, ?2, ?3, ?4)",
        "UPDATE chunks SET key = ?1 WHERE key = (SELECT key FROM chunks LIMIT 1 OFFSET ?2)",
        "UPDATE chunks SET origin = ?1",
        "UPDATE chunks SET data = ?1",
        "UPDATE settings SET value = ?1",
        "DELETE FROM settings WHERE name = ?1",
        "DELETE FROM blocks WHERE id = ?1",
        "DELETE FROM blocks",
        "DELETE FROM settings",
    };
    const Statement row = prepare(database, input.oneOf(kStatements));
    for (int at = 1; row && at <= sqlite3_bind_parameter_count(row.get()); ++at) bindAny(row, at, input);
    run(row);
}

void changeMarks(sqlite3* database, FuzzInput& input) {
    static constexpr const char* kMarks[] = {"application_id", "user_version", "encoding", "journal_mode"};
    const std::string value =
        std::to_string(static_cast<std::int32_t>(input.number(2) % 2 ? input.number(4) : input.byte()));
    const std::string sql = std::string("PRAGMA ") + input.oneOf(kMarks) + " = " + value;
    run(prepare(database, sql.c_str()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    FuzzInput input(data, size);
    const bool isTall = size / 8 % 2 == 1;
    const world::Heights heights = isTall ? world::Heights{-64, 320} : world::Heights();
    fuzz::writeSave(isTall ? fuzz::tallSave() : fuzz::smallSave());
    {
        sqlite3* handle = nullptr;
        fuzz::require(sqlite3_open(fuzz::savePath().c_str(), &handle) == SQLITE_OK);
        const Database database(handle);
        run(prepare(handle, "PRAGMA synchronous = OFF"));
        run(prepare(handle, "BEGIN"));
        for (int changes = 0; !input.isEmpty() && changes < 64; ++changes) {
            const std::uint8_t what = input.byte() % 8;
            if (what < 3) {
                changeChunk(handle, input, heights);
            } else if (what < 5) {
                changeSetting(handle, input);
            } else if (what < 7) {
                changeRow(handle, input);
            } else {
                changeMarks(handle, input);
            }
        }
        // Mostly without the checksum of settings and block names, so that changed rows are accepted.
        if (size % 8 != 0) run(prepare(handle, "UPDATE settings SET value = '' WHERE name = 'checksum'"));
        run(prepare(handle, "COMMIT"));
    }
    fuzz::useSave();
    return 0;
}
