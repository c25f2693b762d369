// A queue in the database of areas that any number of workers generate, cut into squares of chunks. A worker
// takes a square under a lease, which it renews while it works; the square of a killed worker becomes
// available when its lease ends. Generation is deterministic, so repeating a square is harmless. One thread
// at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "terrane/store_postgres/connection.h"
#include "terrane/world/coords.h"

namespace terrane::store_postgres {

constexpr int kJobSide = 32;  // chunks
constexpr std::chrono::seconds kLease{15};

enum class JobOrder : std::uint8_t {
    Spiral,  // from the center outward
    Rows,
};

struct Job {
    std::int64_t number = 0;
    world::ChunkArea area;
};

// Adds an area as jobs, all or nothing; false if the queue already had the same area and it was not
// cancelled.
[[nodiscard]] base::Result<bool> addArea(Connection& connection, const world::ChunkArea& area,
                                         JobOrder order);

// Adds a worker and returns its number. The name is for display.
[[nodiscard]] base::Result<std::int64_t> addWorker(Connection& connection, const std::string& name);
// Removes a worker that ended and releases its job. Its chunks only remain in the totals.
[[nodiscard]] base::Result<void> removeWorker(Connection& connection, std::int64_t worker);

// Takes the next job under a lease. No value if none is waiting or the work is paused.
[[nodiscard]] base::Result<std::optional<Job>> takeJob(Connection& connection, std::int64_t worker);
// Renews the lease and reports progress: `chunks` since the last call, `rate` in chunks per second. False if
// the job was cancelled or taken by another worker; finished chunks stay.
[[nodiscard]] base::Result<bool> renewLease(Connection& connection, std::int64_t worker, const Job& job,
                                            std::int64_t chunks, double rate);
// Reports an idle worker as alive.
[[nodiscard]] base::Result<void> tellAlive(Connection& connection, std::int64_t worker, std::int64_t chunks);
// Call when all chunks of the job are durable.
[[nodiscard]] base::Result<void> finishJob(Connection& connection, const Job& job);

// While paused, workers finish their jobs and take no new ones.
[[nodiscard]] base::Result<void> setPaused(Connection& connection, bool isPaused);
// Cancels all unfinished jobs; returns their number.
[[nodiscard]] base::Result<std::int64_t> cancelJobs(Connection& connection);

struct WorkerStatus {
    std::string name;
    std::int64_t chunks = 0;
    double rate = 0;                       // chunks per second
    double silentSeconds = 0;              // since its last report
    std::optional<world::ChunkArea> area;  // current job
};
struct WorkStatus {
    bool isPaused = false;
    std::int64_t waiting = 0, working = 0, done = 0, cancelled = 0;  // jobs
    std::int64_t chunks = 0, chunksDone = 0;  // of jobs not cancelled; of finished jobs
    double rate = 0;                          // of all active workers
    std::vector<WorkerStatus> workers;        // that reported within a minute
};
[[nodiscard]] base::Result<WorkStatus> workStatus(Connection& connection);

// The index of a square on a spiral around 0,0, which has index 0: squares at a greater Chebyshev distance
// come later.
std::int64_t spiralPlace(std::int64_t x, std::int64_t y);

}  // namespace terrane::store_postgres
