#include "terrane/store_postgres/work_queue.h"

#include <algorithm>
#include <cstdlib>

namespace terrane::store_postgres {
namespace {

// Maximum per area: 2^20 squares of 2^10 chunks.
constexpr std::int64_t kMaxJobs = 1 << 20;

// Times are those of the database's clock, the only one that all workers share. It may be set back: a lease
// that would last longer than any does has ended, like one that lies in the past.
constexpr Statement kHasArea = {
    "SELECT EXISTS (SELECT 1 FROM work_areas a WHERE x0 = $1 AND y0 = $2 AND x1 = $3 AND y1 = $4 AND NOT "
    "EXISTS "
    "(SELECT 1 FROM jobs WHERE area = a.number AND state = 2))"};
constexpr Statement kLockAreas = {"LOCK TABLE work_areas IN SHARE ROW EXCLUSIVE MODE"};
constexpr Statement kAddArea = {
    "INSERT INTO work_areas (x0, y0, x1, y1) VALUES ($1, $2, $3, $4) RETURNING number"};
constexpr Statement kAddJobs = {
    "INSERT INTO jobs (area, place, x0, y0, x1, y1) SELECT $1, * FROM unnest($2::bigint[], $3::bigint[], "
    "$4::bigint[], $5::bigint[], $6::bigint[])"};
constexpr Statement kAddWorker = {"INSERT INTO workers (name) VALUES ($1) RETURNING number"};
constexpr Statement kGiveBack = {
    "UPDATE jobs SET lease = NULL, worker = NULL WHERE worker = $1 AND state = 0"};
constexpr Statement kRemoveWorker = {"DELETE FROM workers WHERE number = $1"};
constexpr Statement kTake = {
    "UPDATE jobs SET worker = $1, lease = clock_timestamp() + $2 * interval '1 second', attempts = attempts "
    "+ 1 "
    "WHERE number = (SELECT number FROM jobs WHERE state = 0 AND (lease IS NULL OR lease NOT BETWEEN "
    "clock_timestamp() AND clock_timestamp() + $2 * interval '2 seconds') "
    "AND NOT (SELECT is_paused FROM work_state) ORDER BY area, place LIMIT 1 FOR UPDATE SKIP LOCKED) "
    "RETURNING number, x0, y0, x1, y1"};
constexpr Statement kRenew = {
    "UPDATE jobs SET lease = clock_timestamp() + $3 * interval '1 second' WHERE number = $2 AND worker = $1 "
    "AND "
    "state = 0"};
constexpr Statement kTellWorking = {
    "UPDATE workers SET seen = clock_timestamp(), chunks = chunks + $2, rate = $3::double precision / 1000, "
    "job = $4 WHERE number = $1"};
constexpr Statement kTellAlive = {
    "UPDATE workers SET seen = clock_timestamp(), chunks = chunks + $2, rate = 0, job = NULL WHERE number = "
    "$1"};
constexpr Statement kFinish = {"UPDATE jobs SET state = 1, lease = NULL WHERE number = $1 AND state = 0"};
constexpr Statement kPause = {"UPDATE work_state SET is_paused = ($1 <> 0)"};
constexpr Statement kCancel = {"UPDATE jobs SET state = 2, lease = NULL WHERE state = 0"};
constexpr Statement kJobCounts = {
    "SELECT count(*) FILTER (WHERE state = 0 AND (lease IS NULL OR lease NOT BETWEEN clock_timestamp() AND "
    "clock_timestamp() + $1 * interval '2 seconds')), "
    "count(*) FILTER (WHERE state = 0 AND lease BETWEEN clock_timestamp() AND clock_timestamp() + $1 * "
    "interval '2 seconds'), count(*) FILTER (WHERE state = 1), "
    "count(*) FILTER (WHERE state = 2), "
    "coalesce(sum((x1 - x0)::bigint * (y1 - y0)) FILTER (WHERE state < 2), 0)::bigint, "
    "coalesce(sum((x1 - x0)::bigint * (y1 - y0)) FILTER (WHERE state = 1), 0)::bigint, "
    "(SELECT is_paused FROM work_state) FROM jobs"};
constexpr Statement kWorkers = {
    "SELECT name, chunks, (rate * 1000)::bigint, "
    "(greatest(extract(epoch FROM clock_timestamp() - seen), 0) * 1000)::bigint, x0, y0, x1, y1 FROM workers "
    "LEFT JOIN jobs ON jobs.number = workers.job AND jobs.worker = workers.number AND jobs.state = 0 "
    "WHERE abs(extract(epoch FROM clock_timestamp() - seen)) < 60 ORDER BY workers.number"};

world::ChunkArea areaOf(const Rows& rows, int row, int column) {
    const auto at = [&](int k) { return static_cast<std::int32_t>(rows.number(row, column + k)); };
    return {at(0), at(1), at(2), at(3)};
}

Parameters parametersOf(const world::ChunkArea& area) {
    return Parameters().integer(area.x0).integer(area.y0).integer(area.x1).integer(area.y1);
}

// Squares as table columns. They are aligned to a grid of the world, so overlapping areas share them.
struct JobColumns {
    std::vector<std::int64_t> place, x0, y0, x1, y1;
};

JobColumns jobsOf(const world::ChunkArea& area, JobOrder order) {
    const auto square = [](std::int32_t chunk) { return std::int64_t{chunk} >> 5; };
    static_assert(kJobSide == 32);
    const std::int64_t left = square(area.x0), right = square(area.x1 - 1);
    const std::int64_t bottom = square(area.y0), top = square(area.y1 - 1);
    const std::int64_t middleX = (left + right) >> 1, middleY = (bottom + top) >> 1;
    JobColumns jobs;
    for (std::int64_t y = bottom; y <= top; ++y)
        for (std::int64_t x = left; x <= right; ++x) {
            const auto inArea = static_cast<std::int64_t>(jobs.place.size());
            jobs.place.push_back(order == JobOrder::Rows ? inArea : spiralPlace(x - middleX, y - middleY));
            jobs.x0.push_back(std::max<std::int64_t>(x * kJobSide, area.x0));
            jobs.y0.push_back(std::max<std::int64_t>(y * kJobSide, area.y0));
            jobs.x1.push_back(std::min<std::int64_t>((x + 1) * kJobSide, area.x1));
            jobs.y1.push_back(std::min<std::int64_t>((y + 1) * kJobSide, area.y1));
        }
    return jobs;
}

// Runs inside a transaction.
base::Result<bool> addAreaLocked(Connection& connection, const world::ChunkArea& area, JobOrder order) {
    TERRANE_TRY(connection.change(kLockAreas));
    const auto there = TERRANE_TRY(connection.run(kHasArea, parametersOf(area)));
    if (there.number(0, 0) != 0) return false;
    const auto added = TERRANE_TRY(connection.run(kAddArea, parametersOf(area)));
    const JobColumns jobs = jobsOf(area, order);
    return connection
        .change(kAddJobs, Parameters()
                              .number(added.number(0, 0))
                              .numbers(jobs.place)
                              .numbers(jobs.x0)
                              .numbers(jobs.y0)
                              .numbers(jobs.x1)
                              .numbers(jobs.y1))
        .map([] { return true; });
}

}  // namespace

// Ring by ring: the ring at distance r starts at index (2r - 1)² and has 8 r squares, counted
// counterclockwise from its lower left corner.
std::int64_t spiralPlace(std::int64_t x, std::int64_t y) {
    const std::int64_t r = std::max(std::abs(x), std::abs(y));
    if (r == 0) return 0;
    const std::int64_t first = (2 * r - 1) * (2 * r - 1);
    if (y == -r && x < r) return first + x + r;
    if (x == r && y < r) return first + 2 * r + y + r;
    if (y == r && x > -r) return first + 4 * r + r - x;
    return first + 6 * r + r - y;
}

base::Result<bool> addArea(Connection& connection, const world::ChunkArea& area, JobOrder order) {
    const auto squares = [](std::int64_t first, std::int64_t end) {
        return ((end - 1) >> 5) - (first >> 5) + 1;
    };
    if (squares(area.x0, area.x1) * squares(area.y0, area.y1) > kMaxJobs)
        return base::fail(base::ErrorCode::BadInput,
                          "an area of {} chunks is too large; at most {} squares of {}×{}", area.chunkCount(),
                          kMaxJobs, kJobSide, kJobSide);
    return inTransaction(connection, [&] { return addAreaLocked(connection, area, order); });
}

base::Result<std::int64_t> addWorker(Connection& connection, const std::string& name) {
    const auto rows = TERRANE_TRY(connection.run(kAddWorker, Parameters().text(name)));
    return rows.number(0, 0);
}

base::Result<void> removeWorker(Connection& connection, std::int64_t worker) {
    const std::vector<Command> commands = {{&kGiveBack, Parameters().number(worker)},
                                           {&kRemoveWorker, Parameters().number(worker)}};
    return connection.changeAll(commands);
}

base::Result<std::optional<Job>> takeJob(Connection& connection, std::int64_t worker) {
    const auto rows = TERRANE_TRY(connection.run(kTake, Parameters().number(worker).number(kLease.count())));
    if (rows.count() == 0) return std::optional<Job>();
    return std::optional(Job{rows.number(0, 0), areaOf(rows, 0, 1)});
}

base::Result<bool> renewLease(Connection& connection, std::int64_t worker, const Job& job,
                              std::int64_t chunks, double rate) {
    const auto perThousandSeconds = static_cast<std::int64_t>(rate * 1000);
    const std::vector<Command> commands = {
        {&kRenew, Parameters().number(worker).number(job.number).number(kLease.count())},
        {&kTellWorking,
         Parameters().number(worker).number(chunks).number(perThousandSeconds).number(job.number)}};
    const auto rows = TERRANE_TRY(connection.runAll(commands));
    return rows.front().affected() == 1;
}

base::Result<void> tellAlive(Connection& connection, std::int64_t worker, std::int64_t chunks) {
    return connection.change(kTellAlive, Parameters().number(worker).number(chunks));
}

base::Result<void> finishJob(Connection& connection, const Job& job) {
    return connection.change(kFinish, Parameters().number(job.number));
}

base::Result<void> setPaused(Connection& connection, bool isPaused) {
    return connection.change(kPause, Parameters().number(isPaused ? 1 : 0));
}

base::Result<std::int64_t> cancelJobs(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kCancel));
    return rows.affected();
}

base::Result<WorkStatus> workStatus(Connection& connection) {
    const auto counts = TERRANE_TRY(connection.run(kJobCounts, Parameters().number(kLease.count())));
    WorkStatus status;
    status.waiting = counts.number(0, 0);
    status.working = counts.number(0, 1);
    status.done = counts.number(0, 2);
    status.cancelled = counts.number(0, 3);
    status.chunks = counts.number(0, 4);
    status.chunksDone = counts.number(0, 5);
    status.isPaused = counts.number(0, 6) != 0;
    const auto workers = TERRANE_TRY(connection.run(kWorkers));
    for (int row = 0; row < workers.count(); ++row) {
        WorkerStatus worker{std::string(workers.text(row, 0)), workers.number(row, 1),
                            static_cast<double>(workers.number(row, 2)) / 1000,
                            static_cast<double>(workers.number(row, 3)) / 1000, std::nullopt};
        if (!workers.isNull(row, 4)) worker.area = areaOf(workers, row, 4);
        // A killed worker is still listed, but no longer works.
        if (worker.silentSeconds < static_cast<double>(kLease.count())) status.rate += worker.rate;
        status.workers.push_back(std::move(worker));
    }
    return status;
}

}  // namespace terrane::store_postgres
