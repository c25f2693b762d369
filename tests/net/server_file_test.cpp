#include "terrane/net/server/sqlite_records.h"

#include <atomic>
#include <memory>
#include <utility>

#include "terrane/base/files.h"
#include "tests/base/wait_until.h"
#include "tests/net/server_file_fixture.h"

namespace terrane::net {
namespace {

TEST(ServerFilePath, IsBesideTheWorld) {
    EXPECT_EQ(store::serverFilePath("a/home.sqlite"), "a/home.server.sqlite");
}

ServerFile::Write setState(int value) {
    return [value](store::Database& database) {
        return database.execute(fmt::format("INSERT OR REPLACE INTO state VALUES ('x', {})", value));
    };
}

std::int64_t state(ServerFile& file) {
    return file.reader().queryNumber("SELECT value FROM state WHERE name = 'x'").value().value_or(-1);
}

// What is written into a file that is gone is lost: it is not durable until the file is back.
TEST_F(ServerFileTest, NothingIsDurableInAFileThatIsGone) {
    (void)file_->write(setState(1));
    flush();
    for (const char* name : {"w.server.sqlite", "w.server.sqlite-wal"}) {
        const auto path = folder_ / name, away = folder_ / "away";
        std::filesystem::rename(path, away);
        const std::uint64_t number = file_->write(setState(2));
        const auto flushed = file_->flush();
        ASSERT_FALSE(flushed) << name;
        EXPECT_THAT(flushed.error().message, testing::HasSubstr("deleted or moved while it was open"));
        EXPECT_LT(file_->durable(), number);
        std::filesystem::rename(away, path);
        EXPECT_TRUE(base::waitUntil([&] { return file_->durable() >= number; }));
    }
    EXPECT_EQ(state(*file_), 2);
}

TEST_F(ServerFileTest, WritesAreMadeInTheirOrder) {
    std::uint64_t number = 0;
    for (int k = 1; k <= 100; ++k) number = file_->write(setState(k));
    EXPECT_EQ(number, 100u);
    flush();
    EXPECT_EQ(file_->durable(), 100u);
    EXPECT_EQ(state(*file_), 100);
}

TEST_F(ServerFileTest, TheEndWritesWhatWaits) {
    file_->write(setState(7));
    open();
    EXPECT_EQ(state(*file_), 7);
}

TEST_F(ServerFileTest, AFailureIsToldAndTriedAgain) {
    std::atomic<bool> isFull = true;
    file_->write([&](store::Database& database) -> base::Result<void> {
        if (isFull) return base::fail("the disk is full");
        return setState(3)(database);
    });
    file_->write(setState(4));
    const auto failed = file_->flush();
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "the disk is full");
    EXPECT_EQ(file_->problem(), "the disk is full");
    EXPECT_EQ(file_->durable(), 0u);
    EXPECT_EQ(state(*file_), -1) << "all or nothing";
    isFull = false;
    // An earlier attempt may still fail.
    while (!file_->flush()) continue;
    EXPECT_EQ(state(*file_), 4);
    EXPECT_EQ(file_->problem(), "");
    EXPECT_EQ(file_->durable(), 2u);
}

TEST_F(ServerFileTest, AlternatingFailuresAreToldOnce) {
    testing::internal::CaptureStderr();
    for (int k = 0; k < 5; ++k) {
        const auto isFirst = std::make_shared<bool>(true);
        file_->write([isFirst](store::Database&) -> base::Result<void> {
            if (std::exchange(*isFirst, false)) return base::fail("the disk is full");
            return {};
        });
        while (!file_->flush()) continue;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "terrane: error: the disk is full\n");
}

TEST_F(ServerFileTest, HasOneServerAtATime) {
    const auto second = ServerFile::open(folder_ / "w.server.sqlite", contentBlocks());
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, base::ErrorCode::Busy);
}

TEST_F(ServerFileTest, OtherFilesAreRefused) {
    ASSERT_TRUE(base::writeFile(folder_ / "text.sqlite", std::string(5000, 'x')));
    EXPECT_FALSE(ServerFile::open(folder_ / "text.sqlite", contentBlocks()));
    {
        auto other = store::Database::open(folder_ / "other.sqlite", store::OpenMode::Create);
        ASSERT_TRUE(other->execute("CREATE TABLE t (x)"));
    }
    const auto other = ServerFile::open(folder_ / "other.sqlite", contentBlocks());
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, base::ErrorCode::Incompatible);
}

}  // namespace
}  // namespace terrane::net
