// Areas of a world that any number of workers generate: a queue of squares of chunks in the database. A
// worker takes one under a lease, which it renews while it works; what a killed worker had goes back when its
// lease ends. Chunks follow from their place, so a square that is made twice is the same. One thread at a
// time.
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
    Spiral,  // from the middle outward
    Rows,
};

struct Job {
    std::int64_t number = 0;
    world::ChunkArea area;
};

// Cut into jobs, all or nothing; false: the queue has had the same area, and it was not cancelled.
[[nodiscard]] base::Result<bool> addArea(Connection& connection, const world::ChunkArea& area,
                                         JobOrder order);

// The worker's number. Its name is for people.
[[nodiscard]] base::Result<std::int64_t> addWorker(Connection& connection, const std::string& name);
// A worker that ended gives its job back and is forgotten; its chunks count for the world alone.
[[nodiscard]] base::Result<void> removeWorker(Connection& connection, std::int64_t worker);

// The next job, under a lease. Nothing where none waits, or the work is paused.
[[nodiscard]] base::Result<std::optional<Job>> takeJob(Connection& connection, std::int64_t worker);
// The lease begins anew, and others see how far the worker is: `chunks` since the last call, `rate` a second.
// False: the job is cancelled, or another worker has it; what was made of it stays.
[[nodiscard]] base::Result<bool> renewLease(Connection& connection, std::int64_t worker, const Job& job,
                                            std::int64_t chunks, double rate);
// The same without a job: the worker is there.
[[nodiscard]] base::Result<void> tellAlive(Connection& connection, std::int64_t worker, std::int64_t chunks);
// When all its chunks are durable.
[[nodiscard]] base::Result<void> finishJob(Connection& connection, const Job& job);

// Paused: workers end what they have, and take no job until it goes on.
[[nodiscard]] base::Result<void> setPaused(Connection& connection, bool isPaused);
// All jobs that are not done; how many.
[[nodiscard]] base::Result<std::int64_t> cancelJobs(Connection& connection);

struct WorkerStatus {
    std::string name;
    std::int64_t chunks = 0;
    double rate = 0;                       // chunks a second
    double silentSeconds = 0;              // since it was heard of
    std::optional<world::ChunkArea> area;  // that it works on
};
struct WorkStatus {
    bool isPaused = false;
    std::int64_t waiting = 0, working = 0, done = 0, cancelled = 0;  // jobs
    std::int64_t chunks = 0, chunksDone = 0;  // of jobs that are not cancelled; of those done
    double rate = 0;                          // of all workers that are there
    std::vector<WorkerStatus> workers;        // that were heard of within a minute
};
[[nodiscard]] base::Result<WorkStatus> workStatus(Connection& connection);

// The number of a square on a spiral around 0,0, which is 0: squares at a greater distance (Chebyshev) come
// later.
std::int64_t spiralPlace(std::int64_t x, std::int64_t y);

}  // namespace terrane::store_postgres
