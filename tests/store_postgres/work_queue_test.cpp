// Leases in the clock of the database, which may be set.
#include "terrane/store_postgres/work_queue.h"

#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

class WorkQueueTest : public PostgresWorldTest {
  protected:
    void SetUp() override {
        makeWorld();
        connection_.emplace(Connection::open(address_).value());
        ASSERT_TRUE(addArea(*connection_, {0, 0, kJobSide, kJobSide}, JobOrder::Rows).value());
        first_ = addWorker(*connection_, "first").value();
        second_ = addWorker(*connection_, "second").value();
    }
    WorkStatus status() { return workStatus(*connection_).value(); }
    // Times in the tables are as before, so setting the clock back moves them ahead of it.
    void setClockBack(const std::string& interval) {
        sql("UPDATE jobs SET lease = lease + interval '" + interval + "'");
        sql("UPDATE workers SET seen = seen + interval '" + interval + "'");
    }

    std::optional<Connection> connection_;
    std::int64_t first_ = 0, second_ = 0;
};

TEST_F(WorkQueueTest, ALeaseIsForOneWorkerUntilItEnds) {
    ASSERT_TRUE(takeJob(*connection_, first_).value());
    EXPECT_FALSE(takeJob(*connection_, second_).value());
    EXPECT_EQ(status().working, 1);
    sql("UPDATE jobs SET lease = lease - interval '1 minute'");
    EXPECT_EQ(status().waiting, 1);
    EXPECT_TRUE(takeJob(*connection_, second_).value());
}

// The job of a killed worker is not lost until the clock is where it was.
TEST_F(WorkQueueTest, ALeaseEndsAlsoIfTheClockIsSetBack) {
    ASSERT_TRUE(takeJob(*connection_, first_).value());
    setClockBack("1 hour");
    EXPECT_EQ(status().waiting, 1);
    EXPECT_EQ(status().working, 0);
    EXPECT_TRUE(status().workers.empty()) << "seen in an hour";
    EXPECT_TRUE(takeJob(*connection_, second_).value());
    EXPECT_EQ(status().working, 1);
}

TEST_F(WorkQueueTest, AWorkerKeepsItsJobIfTheClockIsSet) {
    const auto job = takeJob(*connection_, first_).value();
    ASSERT_TRUE(job);
    for (const char* interval : {"1 hour", "-1 year"}) {
        setClockBack(interval);
        EXPECT_TRUE(renewLease(*connection_, first_, *job, 1, 1).value()) << "nobody has taken it";
        EXPECT_FALSE(takeJob(*connection_, second_).value());
    }
    setClockBack("3 seconds");  // a small correction
    EXPECT_FALSE(takeJob(*connection_, second_).value());
    for (const WorkerStatus& worker : status().workers) EXPECT_GE(worker.silentSeconds, 0);
}

}  // namespace
}  // namespace terrane::store_postgres
