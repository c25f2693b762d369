// Every allocation of C++ and SQLite fails once, or together with all later ones. TERRANE_DEPTH=all tests
// all of them, otherwise forty.
#include <sqlite3.h>

#include <cstdio>
#include <cstdlib>

#include "tests/base/failing_memory.h"
#include "tests/faults/play.h"
#include "tests/support/depth.h"

namespace terrane::store {
namespace {

sqlite3_mem_methods systemMemory;

// SQLite's allocator can only be set before anything else.
const bool isSqliteMemoryOurs = [] {
    sqlite3_config(SQLITE_CONFIG_GETMALLOC, &systemMemory);
    sqlite3_mem_methods failing = systemMemory;
    failing.xMalloc = [](int bytes) -> void* {
        return base::FailingMemory::failsNext() ? nullptr : systemMemory.xMalloc(bytes);
    };
    failing.xRealloc = [](void* memory, int bytes) -> void* {
        return base::FailingMemory::failsNext() ? nullptr : systemMemory.xRealloc(memory, bytes);
    };
    return sqlite3_config(SQLITE_CONFIG_MALLOC, &failing) == SQLITE_OK;
}();

class MemoryFaults : public testing::Test {
  protected:
    static bool isComplete() { return testsAll(); }

    // Returns false if no allocation failed any more.
    bool play(const Start& start, long after, long count) {
        const base::TempFolder folder;
        Play play(folder, start);
        bool hasFailed = false;
        {
            const base::FailingMemory memory(after, count);
            try {
                play.run(count > 1);
            } catch (const std::exception&) {  // simulates the end of the program
            }
            hasFailed = base::FailingMemory::hasFailed();
            allocations_ = base::FailingMemory::allocations();
        }
        EXPECT_TRUE(play.reportsAll || hasFailed) << "nothing failed";
        play.verify();
        return hasFailed;
    }

    void failAll(const Start& start, long count) {
        ASSERT_TRUE(isSqliteMemoryOurs);
        if (!base::FailingMemory::isPossible()) GTEST_SKIP() << "memory does not fail under this sanitizer";
        FaultyDisk disk;
        testing::internal::CaptureStderr();
        (void)play(start, LONG_MAX - 1, 1);  // counts the allocations
        const long step = isComplete() ? 1 : 1 + allocations_ / 40;
        long runs = 0;
        for (long n = 0;; n += step) {
            SCOPED_TRACE(fmt::format("allocation {}, {} times", n, count));
            if (!play(start, n, count)) break;
            ++runs;
            if (HasFailure()) break;
        }
        testing::internal::GetCapturedStderr();
        EXPECT_GT(runs, 0);
        std::printf("%ld of %ld allocations failed\n", runs, allocations_);
    }

    long allocations_ = 0;  // during the last play
};

TEST_F(MemoryFaults, ATransactionIsRolledBackWithoutMemory) {
    const base::TempFolder folder;
    auto database = Database::open(folder / "a.sqlite", OpenMode::Create);
    ASSERT_TRUE(database);
    ASSERT_TRUE(database->execute("CREATE TABLE t (a)"));
    if (!base::FailingMemory::isPossible()) GTEST_SKIP() << "memory does not fail under this sanitizer";
    {
        auto transaction = Transaction::begin(*database);
        ASSERT_TRUE(transaction);
        ASSERT_TRUE(database->execute("INSERT INTO t VALUES (1)"));
        const base::FailingMemory memory(0);
        { const Transaction ended = std::move(*transaction); }
    }
    const auto next = Transaction::begin(*database);  // rolls back if that failed before
    EXPECT_TRUE(next);
    EXPECT_EQ(*database->queryNumber("SELECT count(*) FROM t"), 0);
}

TEST_F(MemoryFaults, ATransactionWithNothingToRollBackEnds) {
    const base::TempFolder folder;
    auto database = Database::open(folder / "a.sqlite", OpenMode::Create);
    ASSERT_TRUE(database);
    ASSERT_TRUE(database->execute("CREATE TABLE t (a)"));
    if (!base::FailingMemory::isPossible()) GTEST_SKIP() << "memory does not fail under this sanitizer";
    {
        auto transaction = Transaction::begin(*database);
        ASSERT_TRUE(transaction);
        ASSERT_TRUE(database->execute("INSERT INTO t VALUES (1); COMMIT")) << "there is nothing to roll back";
        const base::FailingMemory memory(0);
        { const Transaction ended = std::move(*transaction); }
    }
    EXPECT_EQ(*database->queryNumber("SELECT count(*) FROM t"), 1);
}

// A parameter that could not be bound is NULL, which equals nothing: the statement would do nothing and
// succeed.
TEST_F(MemoryFaults, AStatementWithoutItsParameterFails) {
    const base::TempFolder folder;
    auto database = Database::open(folder / "a.sqlite", OpenMode::Create);
    ASSERT_TRUE(database);
    ASSERT_TRUE(database->execute("CREATE TABLE t (a)"));
    ASSERT_TRUE(database->execute("INSERT INTO t VALUES ('x')"));
    auto statement = database->prepare("DELETE FROM t WHERE a = ?1");
    ASSERT_TRUE(statement);
    if (!base::FailingMemory::isPossible()) GTEST_SKIP() << "memory does not fail under this sanitizer";
    const std::string longText(5000, 'x');
    {
        const base::FailingMemory memory(0);
        statement->bind(1, std::string_view(longText));
    }
    const auto done = statement->run();
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, base::ErrorCode::OutOfResources);
    statement->bind(1, std::string_view("x"));
    EXPECT_TRUE(statement->run());
    EXPECT_EQ(*database->queryNumber("SELECT count(*) FROM t"), 0);
}

TEST_F(MemoryFaults, EachFailsOnceInANewSave) {
    failAll(emptyFolder(), 1);
}
TEST_F(MemoryFaults, EachFailsFromThenOnInANewSave) {
    failAll(emptyFolder(), LONG_MAX);
}
TEST_F(MemoryFaults, EachFailsOnceInAMigration) {
    failAll(saveOfFormat1(), 1);
}
TEST_F(MemoryFaults, EachFailsOnceWithDamagedRows) {
    failAll(saveWithDamagedRows(), 1);
}

}  // namespace
}  // namespace terrane::store
