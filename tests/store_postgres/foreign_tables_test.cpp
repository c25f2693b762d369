// Schemas that are not worlds of this format: each is refused with one line, and not changed.
#include "terrane/store_postgres/schema.h"

#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

using base::ErrorCode;

class ForeignTablesTest : public PostgresWorldTest {
  protected:
    void expectRefused(ErrorCode code, const std::string& reason) {
        for (const base::Error& error :
             {errorOf(tryOpen()), errorOf(tryOpen(kWorldMustBeThere)), errorOf(tryOpen(regenerateBy(9))),
              errorOf(openReader(address_, registry_))})
            expectError(error, code, address_.shown, reason);
    }
    // Changes a valid world, then expects an error.
    void expectDamage(const std::string& change, ErrorCode code, const std::string& reason) {
        SCOPED_TRACE(change);
        sql("DROP SCHEMA IF EXISTS " + schema_ + " CASCADE");
        makeWorld(1);
        sql(change);
        expectRefused(code, reason);
    }
    Connection connect() { return Connection::open(address_).value(); }
    // The schema's tables and its format.
    std::string tables() {
        return query(
            "SELECT string_agg(relname, ' ' ORDER BY relname) FROM pg_class WHERE relkind = 'r' "
            "AND relnamespace = '" +
            schema_ + "'::regnamespace");
    }
};

TEST_F(ForeignTablesTest, TablesOfAnotherProgram) {
    sql("CREATE SCHEMA " + schema_ + "; CREATE TABLE chunks (key bigint); INSERT INTO chunks VALUES (5)");
    expectRefused(ErrorCode::Incompatible, "the schema holds tables of another program, not a world");
    sql("DROP TABLE chunks; CREATE VIEW terrane_format AS SELECT 1 AS format");
    expectRefused(ErrorCode::Incompatible, "the schema holds tables of another program, not a world");
    EXPECT_EQ(tables(), "");
}

TEST_F(ForeignTablesTest, Formats) {
    const auto newest = std::to_string(newestFormat() + 1);
    expectDamage("UPDATE terrane_format SET format = 99", ErrorCode::Incompatible,
                 "in format 99, this program reads up to format " + newest + ": use a newer version");
    const char* damaged = "damaged: its format is not one number above 0";
    expectDamage("UPDATE terrane_format SET format = 0", ErrorCode::Damaged, damaged);
    expectDamage("UPDATE terrane_format SET format = -1", ErrorCode::Damaged, damaged);
    expectDamage("DELETE FROM terrane_format", ErrorCode::Damaged, damaged);
    expectDamage("INSERT INTO terrane_format VALUES (3)", ErrorCode::Damaged, damaged);
}

TEST_F(ForeignTablesTest, OtherColumns) {
    const std::pair<const char*, const char*> cases[] = {
        {"ALTER TABLE chunks ALTER key TYPE text", "chunks.key is text, expected bigint"},
        {"ALTER TABLE chunks ALTER data TYPE text", "chunks.data is text, expected bytea"},
        {"ALTER TABLE settings DROP value", "settings.value is missing, expected text"},
        {"DROP TABLE chunks", "chunks.key is missing, expected bigint"},
        {"DROP TABLE edits; CREATE VIEW edits AS SELECT 1::bigint AS number, ''::bytea AS blocks",
         "edits.number is missing, expected bigint"},
    };
    for (const auto& [change, reason] : cases)
        expectDamage(change, ErrorCode::Incompatible, std::string("not a world: ") + reason);
}

TEST_F(ForeignTablesTest, Settings) {
    expectDamage("DELETE FROM settings WHERE name = 'seed'", ErrorCode::Damaged,
                 "the setting seed is missing");
    expectDamage("UPDATE settings SET value = 'x' WHERE name = 'seed'", ErrorCode::Damaged,
                 "the setting seed is \"x\"");
    expectDamage("DELETE FROM settings WHERE name = 'generator'", ErrorCode::Damaged,
                 "the setting generator is missing");
    expectDamage("INSERT INTO settings SELECT 'x' || n, '' FROM generate_series(1, 5000) AS n",
                 ErrorCode::Damaged, "more than 4096 settings");
    expectDamage("INSERT INTO settings VALUES ('x', repeat('x', 17 << 20))", ErrorCode::Damaged,
                 "more than 16777216 bytes");
}

TEST_F(ForeignTablesTest, BlockNames) {
    expectDamage(
        "ALTER TABLE blocks DROP CONSTRAINT blocks_id_check; INSERT INTO blocks VALUES (70000, 'far')",
        ErrorCode::Damaged, "the block far has the id 70000");
    expectDamage(
        "ALTER TABLE blocks DROP CONSTRAINT blocks_name_key; INSERT INTO blocks VALUES (99, 'stone')",
        ErrorCode::Damaged, "the block stone occurs twice");
    expectDamage("ALTER TABLE blocks DROP CONSTRAINT blocks_pkey; INSERT INTO blocks VALUES (1, 'other')",
                 ErrorCode::Damaged, "occurs twice");
}

TEST_F(ForeignTablesTest, AnOlderFormatIsMigratedWhereItIsWritten) {
    const auto former = formatSteps().first(formatSteps().size() - 1);
    {
        Connection connection = connect();
        ASSERT_TRUE(migrate(connection, schema_, 0, former));
    }
    sql("INSERT INTO settings VALUES ('seed', '7'), ('generator', 'flat'), ('generator_version', '3'), "
        "('player', '1,2')");
    expectError(errorOf(openReader(address_, registry_)), ErrorCode::Incompatible, address_.shown,
                "it is migrated to format");
    EXPECT_EQ(query("SELECT format FROM terrane_format"), std::to_string(former.size()));
    const auto store = tryOpen(kWorldMustBeThere);
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ((*store)->metadata("player"), "1,2");
    EXPECT_EQ(query("SELECT format FROM terrane_format"), std::to_string(newestFormat()));
    EXPECT_TRUE(openReader(address_, registry_));
}

TEST_F(ForeignTablesTest, AMigrationIsAllOrNothing) {
    const char* steps[] = {
        "CREATE TABLE terrane_format (format integer NOT NULL); CREATE TABLE a (x integer);",
        "CREATE TABLE b (x integer);", "CREATE TABLE c (x integer); SELECT 1 / 0;"};
    Connection connection = connect();
    expectError(errorOf(migrate(connection, schema_, 0, steps)), ErrorCode::Failed, address_.shown,
                "division by zero");
    EXPECT_EQ(query("SELECT count(*) FROM pg_namespace WHERE nspname = '" + schema_ + "'"), "0");
    ASSERT_TRUE(migrate(connection, schema_, 0, std::span(steps).first(1)));
    expectError(errorOf(migrate(connection, schema_, 1, steps)), ErrorCode::Failed, address_.shown,
                "division by zero");
    EXPECT_EQ(tables(), "a terrane_format");
    ASSERT_TRUE(migrate(connection, schema_, 1, std::span(steps).first(2)));
    EXPECT_EQ(tables(), "a b terrane_format");
    EXPECT_EQ(formatOf(connection, 2).value(), 2);
    EXPECT_EQ(errorOf(formatOf(connection, 1)).code, ErrorCode::Incompatible);
}

// A partially created world would stay damaged.
TEST_F(ForeignTablesTest, AWorldIsMadeWholeOrNotAtAll) {
    store::SaveAccess access = kCreateWorld;
    access.blockNames = {{1, "stone"}, {2, "stone"}};
    expectError(errorOf(tryOpen(access)), ErrorCode::Failed, address_.shown, "duplicate key");
    EXPECT_EQ(query("SELECT count(*) FROM pg_namespace WHERE nspname = '" + schema_ + "'"), "0");
    EXPECT_TRUE(tryOpen());
}

}  // namespace
}  // namespace terrane::store_postgres
