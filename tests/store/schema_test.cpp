#include "terrane/store/sqlite/schema.h"

#include <gmock/gmock.h>

#include "terrane/base/files.h"
#include "tests/base/file_size_limit.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;

// Fictional formats with fictional migrations.
class MigrationTest : public testing::Test {
  protected:
    void SetUp() override {
        auto database = Database::open(path_, OpenMode::Create);
        ASSERT_TRUE(database);
        ASSERT_TRUE(createTables(*database, kIdentity));
        ASSERT_TRUE(database->execute("PRAGMA user_version = 1"));
        ASSERT_TRUE(database->execute("INSERT INTO chunks VALUES (5, 0, x'00')"));
    }
    base::Result<void> migrateTo(std::int64_t target) {
        constexpr Migration kSteps[] = {
            {1, "ALTER TABLE chunks ADD COLUMN level INTEGER NOT NULL DEFAULT 0"},
            {2, "UPDATE chunks SET level = 7; CREATE TABLE more (a)"},
            {3, "UPDATE chunks SET level = 9; CREATE TABLE more (a)"},  // fails: the table exists
        };
        auto database = Database::open(path_, OpenMode::ReadWrite);
        if (!database) return tl::unexpected(database.error());
        return migrate(*database, kSteps, target, backup_);
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite", backup_ = folder_ / "old.sqlite";
};

TEST_F(MigrationTest, StepByStepWithACopyOfTheOld) {
    const auto done = migrateTo(3);
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_EQ(queryFile(path_, "SELECT level FROM chunks WHERE key = 5"), 7);
    EXPECT_EQ(queryFile(path_, "PRAGMA user_version"), 3);
    EXPECT_EQ(queryFile(backup_, "PRAGMA user_version"), 1);
    EXPECT_EQ(queryFile(backup_, "SELECT count(*) FROM pragma_table_info('chunks')"), 3);
}

TEST_F(MigrationTest, AllOrNothing) {
    const auto failed = migrateTo(4);
    ASSERT_FALSE(failed);
    EXPECT_THAT(failed.error().message, HasSubstr("a.sqlite: "));
    EXPECT_EQ(queryFile(path_, "PRAGMA user_version"), 1);
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM pragma_table_info('chunks')"), 3);
    EXPECT_FALSE(std::filesystem::exists(backup_)) << "or each attempt would leave one more";
}

TEST_F(MigrationTest, ACopyThatFailsLeavesNothing) {
    if (!base::FileSizeLimit::kWorks) GTEST_SKIP() << "this system has no limit of file sizes";
    {
        const base::FileSizeLimit limit(8192);  // two of about six pages
        EXPECT_FALSE(migrateTo(3));
    }
    EXPECT_FALSE(std::filesystem::exists(backup_));
    EXPECT_EQ(queryFile(path_, "PRAGMA user_version"), 1);
}

TEST_F(MigrationTest, FormatsWithoutAWayOn) {
    EXPECT_THAT(migrateTo(6).error().message, HasSubstr("unknown format 4"));
    runSql(path_, "PRAGMA user_version = 0");
    EXPECT_THAT(migrateTo(2).error().message, HasSubstr("unknown format 0"));
    EXPECT_FALSE(std::filesystem::exists(backup_)) << "nothing is copied where there is no way";
}

TEST_F(MigrationTest, Kinds) {
    auto database = Database::open(path_, OpenMode::ReadWrite);
    ASSERT_TRUE(database);
    EXPECT_EQ(*classify(*database), SaveKind::Old);
    EXPECT_EQ(*classify(*database, {1, 1}), SaveKind::Current);
    EXPECT_EQ(*classify(*database, {1, 2}), SaveKind::Current);
    EXPECT_EQ(*classify(*database, {2, 2}), SaveKind::Old);
    EXPECT_FALSE(classify(*database, {0, 0})) << "newer than the program";
}

TEST(Database, ACopyReplacesNoFile) {
    const base::TempFolder folder;
    auto database = Database::open(folder / "a.sqlite", OpenMode::Create);
    ASSERT_TRUE(database) << database.error().message;
    ASSERT_TRUE(base::writeFile(folder / "b.sqlite", "of somebody else"));
    const auto copied = database->backUpTo(folder / "b.sqlite");
    ASSERT_FALSE(copied);
    EXPECT_EQ(copied.error().code, base::ErrorCode::BadInput);
    EXPECT_EQ(*base::readFile(folder / "b.sqlite"), "of somebody else");
}

}  // namespace
}  // namespace terrane::store
