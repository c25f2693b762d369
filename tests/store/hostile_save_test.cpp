// Malicious saves: schemas with code, rows of other types, endless page trees. Readers and writers refuse
// each with one line and do not change it.
#include <gmock/gmock.h>

#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/saves/save_check.h"
#include "terrane/store/sqlite/schema.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;

class HostileSaveTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto store = SqliteStore::open(path_, registry_, {.create = kIdentity, .decide = {}});
        ASSERT_TRUE(store);
        for (int x = 0; x < 4; ++x) (*store)->save({x, 0}, numberedChunk(x), Provenance::Edited);
    }
    void rewriteSchema(const std::string& sql) {
        runSql(path_, "PRAGMA writable_schema = ON; " + sql + "; PRAGMA writable_schema = OFF");
    }
    void expectRefused(const std::string& reason) {
        const std::string before = readAll(path_);
        const auto reader = SqliteReader::open(path_, registry_);
        ASSERT_FALSE(reader) << reason;
        EXPECT_EQ(reader.error().code, base::ErrorCode::Damaged);
        EXPECT_THAT(reader.error().message, HasSubstr("a.sqlite: damaged: " + reason));
        const auto writer = SqliteStore::open(path_, registry_, {});
        ASSERT_FALSE(writer) << reason;
        EXPECT_EQ(writer.error().message, reader.error().message);
        const auto report = checkSave(path_, registry_);
        ASSERT_TRUE(report) << report.error().message;
        EXPECT_EQ(report->fileProblems, std::vector<std::string>{reader.error().message});
        EXPECT_TRUE(readAll(path_) == before) << "changed";
    }
    CheckReport check() {
        auto report = checkSave(path_, registry_);
        if (!report) throw std::runtime_error(report.error().message);
        return *report;
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

// A view that counts endlessly.
TEST_F(HostileSaveTest, AViewInPlaceOfATable) {
    for (const std::string name : {"chunks", "quarantine", "settings", "blocks"}) {
        SetUp();
        runSql(path_,
               "DROP TABLE " + name + "; CREATE VIEW " + name +
                   " AS WITH RECURSIVE n(key) AS (SELECT 1 UNION ALL SELECT key + 1 FROM n) "
                   "SELECT key, key AS id, 'x' AS name, 'y' AS value, 0 AS origin, x'' AS data FROM n");
        expectRefused("it has the view \"" + name + "\", which does not belong in a save");
        std::filesystem::remove(path_);
    }
}

TEST_F(HostileSaveTest, OtherObjects) {
    const std::pair<std::string, std::string> cases[] = {
        {"CREATE TRIGGER burn AFTER INSERT ON settings BEGIN DELETE FROM chunks; END",
         "the trigger \"burn\""},
        {"CREATE VIEW v AS SELECT 1 AS a; CREATE TRIGGER t INSTEAD OF INSERT ON v BEGIN DELETE FROM chunks; "
         "END",
         "the view \"v\""},  // found first
        {"CREATE TABLE more (a)", "the table \"more\""},
        {"CREATE INDEX more ON chunks (origin)", "the index \"more\""},
        {"CREATE INDEX more ON chunks (abs(origin))", "the index \"more\""},
        {"CREATE VIRTUAL TABLE more USING fts5 (a)", "the table \"more\""},
        {"ANALYZE", "the table \"sqlite_stat1\""}};
    for (const auto& [sql, object] : cases) {
        runSql(path_, sql);
        expectRefused("it has " + object);
        std::filesystem::remove(path_);
        SetUp();
    }
}

TEST_F(HostileSaveTest, MissingTables) {
    for (const std::string name : {"chunks", "quarantine", "settings", "blocks"}) {
        runSql(path_, "DROP TABLE " + name);
        expectRefused("the table \"" + name + "\" is missing");
        std::filesystem::remove(path_);
        SetUp();
    }
}

TEST_F(HostileSaveTest, OtherColumns) {
    const std::pair<std::string, std::string> cases[] = {
        {"blocks", "id INTEGER, name TEXT NOT NULL UNIQUE"},
        {"chunks", "key INTEGER PRIMARY KEY, origin INTEGER NOT NULL, data BLOB NOT NULL, more"},
        {"chunks", "key INTEGER PRIMARY KEY, origin INTEGER NOT NULL, data AS (zeroblob(100000000))"},
        {"chunks", "key INTEGER PRIMARY KEY, origin INTEGER NOT NULL CHECK (origin > 0), data BLOB NOT NULL"},
        {"chunks", "key INTEGER PRIMARY KEY, origin INTEGER NOT NULL, data BLOB"},
        {"chunks", "key INTEGER PRIMARY KEY, origin TEXT NOT NULL, data BLOB NOT NULL"},
        {"chunks", "data BLOB NOT NULL, key INTEGER PRIMARY KEY, origin INTEGER NOT NULL"},
        {"quarantine", "number INTEGER PRIMARY KEY, key, reason TEXT NOT NULL, data BLOB NOT NULL"}};
    for (const auto& [name, columns] : cases) {
        // Without the index of `blocks`, which would be reported as missing first.
        runSql(path_, "DROP TABLE " + name + "; CREATE TABLE " + name + " (" + columns + ")");
        expectRefused("the table \"" + name + "\" is not that of a save");
        std::filesystem::remove(path_);
        SetUp();
    }
}

TEST_F(HostileSaveTest, TwoTablesOnOnePage) {
    rewriteSchema(
        "UPDATE sqlite_schema SET rootpage = (SELECT rootpage FROM sqlite_schema WHERE name = 'chunks') "
        "WHERE name = 'quarantine'");
    expectRefused("the table \"quarantine\" is not that of a save");
}

TEST_F(HostileSaveTest, TheSameTablesInOtherWords) {
    EXPECT_EQ(normalizedSql("CREATE TABLE \"Blocks\"(\n id\tINTEGER,[name] TEXT DEFAULT 'A b')"),
              normalizedSql("create table blocks ( id integer , `name` text default 'A b' )"));
    EXPECT_NE(normalizedSql("a 'b'"), normalizedSql("a 'B'"));
    EXPECT_NE(normalizedSql("\"key INTEGER\""), normalizedSql("key INTEGER"));
    EXPECT_NE(normalizedSql("ab"), normalizedSql("a b"));
    runSql(path_, "ALTER TABLE chunks RENAME TO other; ALTER TABLE other RENAME TO Chunks");
    EXPECT_FALSE(check().isDamaged());
    EXPECT_TRUE(SqliteStore::open(path_, registry_, {}));
}

TEST_F(HostileSaveTest, AListOfTablesWithoutEnd) {
    std::string sql;
    for (int k = 0; k < 1500; ++k) sql += fmt::format("CREATE TABLE t{} (a);", k);
    runSql(path_, "PRAGMA synchronous = OFF; BEGIN;" + sql + "COMMIT");
    expectRefused("reading it does not end");
}

// Triggers and views are disabled, whatever the schema contains.
TEST_F(HostileSaveTest, NoConnectionRunsWhatAFileBrings) {
    runSql(path_,
           "CREATE TRIGGER burn AFTER INSERT ON settings BEGIN DELETE FROM chunks; END;"
           "CREATE VIEW v AS SELECT 1 AS a");
    auto database = Database::open(path_, OpenMode::ReadWrite);
    ASSERT_TRUE(database);
    ASSERT_TRUE(database->execute("INSERT INTO settings VALUES ('a', 'b')"));
    EXPECT_EQ(*database->queryNumber("SELECT count(*) FROM chunks"), 4);
    EXPECT_FALSE(database->queryNumber("SELECT a FROM v"));
    EXPECT_FALSE(database->execute("ATTACH 'b.sqlite' AS b"));
    ASSERT_TRUE(database->execute("PRAGMA writable_schema = ON"));
    EXPECT_FALSE(database->execute("DELETE FROM sqlite_schema"));
    EXPECT_FALSE(database->queryNumber("SELECT length(zeroblob(100000000))"));
}

// Invalid column types are damage of one chunk: it is quarantined, and new edits are saved.
TEST_F(HostileSaveTest, RowsOfOtherTypes) {
    runSql(path_, fmt::format("UPDATE chunks SET origin = 'abc' WHERE key = {}", keyOf({0, 0})));
    runSql(path_, fmt::format("UPDATE chunks SET data = 'text' WHERE key = {}", keyOf({1, 0})));
    runSql(path_, fmt::format("UPDATE chunks SET origin = 7 WHERE key = {}", keyOf({2, 0})));
    const CheckReport report = check();
    ASSERT_EQ(report.damaged.size(), 3u);
    EXPECT_EQ(report.damaged[0].problem, "its origin is \"abc\", expected 0 or 1");
    EXPECT_EQ(report.damaged[1].problem, "its data is not a blob");
    EXPECT_EQ(report.damaged[2].problem, "its origin is \"7\", expected 0 or 1");
    {
        const auto store = SqliteStore::open(path_, registry_, {});
        ASSERT_TRUE(store);
        EXPECT_EQ((*store)->load({2, 0}).state, LoadedChunk::State::Damaged);
        for (int x = 0; x < 3; ++x) (*store)->save({x, 0}, numberedChunk(x + 50), Provenance::Edited);
        ASSERT_TRUE((*store)->flush());
        for (int x = 0; x < 3; ++x) EXPECT_EQ(*(*store)->load({x, 0}).chunk, *numberedChunk(x + 50)) << x;
    }
    EXPECT_FALSE(check().isDamaged());
    EXPECT_EQ(check().quarantined, 3u);
}

// NOT NULL is only enforced on writes through the schema.
TEST_F(HostileSaveTest, NullInARow) {
    rewriteSchema("UPDATE sqlite_schema SET sql = replace(sql, ' NOT NULL', '') WHERE name = 'chunks'");
    runSql(path_, fmt::format("UPDATE chunks SET data = NULL, origin = NULL WHERE key = {}", keyOf({0, 0})));
    rewriteSchema(
        "UPDATE sqlite_schema SET sql = 'CREATE TABLE chunks (key INTEGER PRIMARY KEY, origin INTEGER "
        "NOT NULL, data BLOB NOT NULL)' WHERE name = 'chunks'");
    ASSERT_EQ(check().damaged.size(), 1u);
    {
        const auto store = SqliteStore::open(path_, registry_, {});
        ASSERT_TRUE(store);
        (*store)->save({0, 0}, numberedChunk(50), Provenance::Edited);
        ASSERT_TRUE((*store)->flush());
        EXPECT_EQ(*(*store)->load({0, 0}).chunk, *numberedChunk(50));
    }
    EXPECT_FALSE(check().isDamaged());
}

TEST_F(HostileSaveTest, NamesAndSettings) {
    const std::pair<std::string, std::string> cases[] = {
        {"UPDATE settings SET value = x'00' WHERE name = 'seed'", "the setting seed is not a text"},
        {"UPDATE blocks SET name = x'00' WHERE id = 1", "the name"},
        {"UPDATE blocks SET name = hex(zeroblob(600)) WHERE id = 1", "the name 0000"},
        {"UPDATE blocks SET id = 65536 WHERE id = 1", "the block stone has the id 65536"},
        {"WITH RECURSIVE n(k) AS (SELECT 1 UNION ALL SELECT k + 1 FROM n WHERE k < 5000) "
         "INSERT INTO settings SELECT 'n' || k, 'v' FROM n",
         "more than 4096 settings"},
        {"INSERT INTO settings VALUES ('a', hex(zeroblob(5000000))), ('b', hex(zeroblob(5000000)))",
         "more than 4096 settings, or more than 16777216 bytes"}};
    for (const auto& [sql, reason] : cases) {
        runSql(path_, sql);
        expectRefused(reason);
        std::filesystem::remove(path_);
        SetUp();
    }
}

// A damaged page may contain duplicate block ids; SQLite does not detect this.
TEST_F(HostileSaveTest, BlockIdsThatComeTwice) {
    std::string bytes = readAll(path_);
    const std::int64_t root = queryFile(path_, "SELECT rootpage FROM sqlite_schema WHERE name = 'blocks'");
    const std::size_t page = static_cast<std::size_t>(root - 1) * 4096;
    bytes[page + 10] = bytes[page + 8];  // the second cell points to the first
    bytes[page + 11] = bytes[page + 9];
    writeAll(path_, bytes);
    expectRefused("the ids of blocks are out of order at 0");
}

// A chain of pages, each the only child of the previous one: SQLite's integrity check recurses and overflows
// the stack.
TEST_F(HostileSaveTest, TreesThatAreTooDeep) {
    for (const std::string name : {"quarantine", "chunks", "sqlite_autoindex_blocks_1"}) {
        constexpr std::size_t kPageBytes = 512;
        runSql(path_, "PRAGMA journal_mode = DELETE; PRAGMA page_size = 512; VACUUM");
        std::string bytes = readAll(path_);
        const auto root = static_cast<std::uint32_t>(
            queryFile(path_, "SELECT rootpage FROM sqlite_schema WHERE name = '" + name + "'"));
        constexpr std::uint32_t kPages = 40000;
        const auto pageCount = static_cast<std::uint32_t>(bytes.size() / kPageBytes);
        const auto put = [&](std::size_t at, std::uint32_t value) {
            for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<char>(value >> (24 - 8 * k));
        };
        const auto makeInner = [&](std::size_t page, std::uint32_t child) {
            std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(page), 12, '\0');
            bytes[page] = name == "sqlite_autoindex_blocks_1" ? 2 : 5;
            bytes[page + 5] = 0x02;  // cells start at the end of the page
            put(page + 8, child);
        };
        bytes.resize(bytes.size() + std::size_t{kPages} * kPageBytes);
        makeInner((root - 1) * kPageBytes, pageCount + 1);
        for (std::uint32_t k = 1; k < kPages; ++k)
            makeInner(std::size_t{pageCount + k - 1} * kPageBytes, pageCount + k + 1);
        put(28, pageCount + kPages);
        writeAll(path_, bytes);
        EXPECT_TRUE(check().isDamaged()) << name;
        std::filesystem::remove(path_);
        SetUp();
    }
}

// A page whose children are all the same page repeats its rows; over several levels, endlessly.
TEST_F(HostileSaveTest, TreesThatShareTheirBranches) {
    for (const std::string name : {"quarantine", "chunks"}) {
        runSql(path_, "INSERT INTO quarantine VALUES (1, 1, 'a', x'00'), (2, 2, 'b', x'00')");
        std::string bytes = readAll(path_);
        const auto root = static_cast<std::uint32_t>(
            queryFile(path_, "SELECT rootpage FROM sqlite_schema WHERE name = '" + name + "'"));
        const std::string leaf = bytes.substr((root - 1) * 4096, 4096);
        const auto pageCount = static_cast<std::uint32_t>(bytes.size() / 4096);
        constexpr std::uint32_t kLevels = 18, kCells = 100;
        const auto inner = [&](std::uint32_t child) {
            std::string page(4096, '\0');
            const auto put = [&](std::size_t at, std::uint32_t value, std::size_t count) {
                for (std::size_t k = 0; k < count; ++k)
                    page[at + k] = static_cast<char>(value >> (8 * (count - 1 - k)));
            };
            put(0, 5, 1);
            put(3, kCells, 2);
            put(5, 4096 - kCells * 5, 2);
            put(8, child, 4);
            for (std::uint32_t k = 0; k < kCells; ++k) {
                put(12 + 2 * k, 4096 - (k + 1) * 5, 2);
                put(4096 - (k + 1) * 5, child, 4);  // and a key of one byte
            }
            return page;
        };
        bytes.replace((root - 1) * 4096, 4096, inner(pageCount + 1));
        for (std::uint32_t k = 1; k <= kLevels; ++k) bytes += k < kLevels ? inner(pageCount + k + 1) : leaf;
        const std::uint32_t pages = pageCount + kLevels;
        bytes[30] = static_cast<char>(pages >> 8);
        bytes[31] = static_cast<char>(pages);
        writeAll(path_, bytes);
        const CheckReport report = check();
        ASSERT_EQ(report.fileProblems.size(), 1u) << name;
        EXPECT_THAT(report.fileProblems[0], HasSubstr("damaged: ")) << name;
        {
            const auto reader = SqliteReader::open(path_, registry_);
            ASSERT_TRUE(reader);
            EXPECT_NE((*reader)->editedChunks().has_value(), name == "chunks");
        }
        std::filesystem::remove(path_);
        SetUp();
    }
}

}  // namespace
}  // namespace terrane::store
