// Faults of a server, a database and a user: each gives one line that names the database.
#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

using base::ErrorCode;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

class OpenFaultsTest : public PostgresWorldTest {
  protected:
    base::Error errorOfWriting(const store::SaveAccess& access = kCreateWorld) {
        return errorOf(tryOpen(access));
    }
    base::Error errorOfReading() { return errorOf(openReader(address_, registry_)); }
    // For reading and writing.
    void expectRefused(ErrorCode code, const std::string& reason) {
        for (const base::Error& error :
             {errorOfWriting(), errorOfWriting(kWorldMustBeThere), errorOfReading()})
            expectError(error, code, address_.shown, reason);
    }
};

TEST_F(OpenFaultsTest, WrongPassword) {
    for (const char* user : {"postgres:wr0ng", "postgres", "nobody:wr0ng"}) {
        address_ = addressOf(sharedServer().networkUrl(user)).value();
        const base::Error error = errorOfWriting();
        expectError(error, ErrorCode::Refused,
                    fmt::format("postgresql://127.0.0.1:{}/postgres", sharedServer().port()),
                    "cannot be reached: ");
        EXPECT_THAT(error.message, HasSubstr("password"));
        EXPECT_THAT(error.message, Not(HasSubstr("wr0ng")));
    }
    address_ = addressOf(sharedServer().networkUrl("postgres:secret") + "?schema=" + schema_).value();
    makeWorld();
    EXPECT_TRUE(openReader(address_, registry_));
}

// "localhost" has two addresses on most machines, and a server may listen on one only.
TEST_F(OpenFaultsTest, TheServerThatAnsweredTellsWhy) {
    address_ = addressOf(fmt::format("postgresql://postgres:wr0ng@127.0.0.1:1,127.0.0.1:{}/postgres",
                                     sharedServer().port()))
                   .value();
    expectRefused(ErrorCode::Refused, "cannot be reached: password authentication failed");
}

TEST_F(OpenFaultsTest, NoServer) {
    address_ = addressOf("postgresql://postgres:s3cret@127.0.0.1:1/postgres?schema=" + schema_).value();
    expectRefused(ErrorCode::Io, "cannot be reached: ");
    EXPECT_THAT(errorOfReading().message, Not(HasSubstr("s3cret")));
    address_ = addressOf("postgresql:///postgres?host=/nowhere").value();
    expectRefused(ErrorCode::Io, "cannot be reached: ");
}

TEST_F(OpenFaultsTest, UnknownHost) {
    address_ = addressOf("postgresql://nowhere.invalid/postgres").value();
    const base::Error error = errorOfWriting();
    const bool isTemporary = error.message.find("Temporary failure") != std::string::npos;
    expectError(error, isTemporary ? ErrorCode::Io : ErrorCode::NotFound, address_.shown, "nowhere.invalid");
}

TEST_F(OpenFaultsTest, UnknownDatabase) {
    address_ = addressOf(urlWith("nothing")).value();
    expectRefused(ErrorCode::NotFound, "database \"nothing\" does not exist");
}

TEST_F(OpenFaultsTest, UnknownUser) {
    address_ = addressOf(urlWith("postgres", "nobody")).value();
    expectRefused(ErrorCode::Refused, "role \"nobody\" does not exist");
}

TEST_F(OpenFaultsTest, NoWorld) {
    expectError(errorOfWriting(kWorldMustBeThere), ErrorCode::NotFound, address_.shown, "there is no world");
    expectError(errorOfReading(), ErrorCode::NotFound, address_.shown, "there is no world");
    EXPECT_EQ(query("SELECT count(*) FROM pg_namespace WHERE nspname = '" + schema_ + "'"), "0")
        << "asking makes nothing";
    sql("CREATE SCHEMA " + schema_);
    expectError(errorOfReading(), ErrorCode::NotFound, address_.shown, "there is no world");
    EXPECT_TRUE(tryOpen()) << "an empty schema is a place for a new one";
}

TEST_F(OpenFaultsTest, AUserWhoMayOnlyRead) {
    makeWorld();
    sql("CREATE ROLE reader LOGIN; GRANT USAGE ON SCHEMA " + schema_ + " TO reader");
    const Address owner = address_;
    address_ = addressOf(urlWith("postgres", "reader") + "&schema=" + schema_).value();
    expectRefused(ErrorCode::Refused, "permission denied for table terrane_format");
    sql("GRANT SELECT ON terrane_format, settings, blocks, chunks TO reader");
    for (const auto& access : {kCreateWorld, kWorldMustBeThere, regenerateBy(9)})
        expectError(errorOfWriting(access), ErrorCode::Refused, address_.shown,
                    "may read the world, not write it");
    const auto reader = openReader(address_, registry_);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(*(*reader)->load({2, 0}).chunk, *store::numberedChunk(2));

    sql("REVOKE USAGE ON SCHEMA " + schema_ + " FROM reader");
    expectRefused(ErrorCode::Refused, "may not use the schema");
    address_ = addressOf(urlWith("postgres", "reader") + "&schema=other").value();
    expectError(errorOfWriting(), ErrorCode::Refused, address_.shown, "permission denied for database");
    address_ = owner;
    EXPECT_EQ(open()->identity(), store::kIdentity) << "nothing was regenerated";
    sql("DROP OWNED BY reader; DROP ROLE reader");
}

TEST_F(OpenFaultsTest, AReadOnlyDatabase) {
    const std::string database = freshDatabase();
    address_ = addressOf(urlWith(database)).value();
    makeWorld();
    sharedServer().sql("ALTER DATABASE " + database + " SET default_transaction_read_only = on");
    expectError(errorOfWriting(), ErrorCode::Refused, address_.shown, "the database is read-only");
    const auto reader = openReader(address_, registry_);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(*(*reader)->load({2, 0}).chunk, *store::numberedChunk(2));
    address_ = addressOf(urlWith(database) + "&schema=new").value();
    expectError(errorOfWriting(), ErrorCode::Refused, address_.shown, "read-only transaction");
}

TEST_F(OpenFaultsTest, ADatabaseInAnotherEncoding) {
    address_ =
        addressOf(urlWith(freshDatabase(" ENCODING 'LATIN1' TEMPLATE template0 LC_COLLATE 'C' LC_CTYPE 'C'")))
            .value();
    expectRefused(ErrorCode::Incompatible, "its encoding is LATIN1, expected UTF8");
}

}  // namespace
}  // namespace terrane::store_postgres
