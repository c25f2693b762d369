#include "terrane/store_postgres/worker.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include "terrane/base/log.h"
#include "terrane/base/timing.h"

namespace terrane::store_postgres {
namespace {

using Clock = std::chrono::steady_clock;

// Chunks generated at a time: enough for all threads or a batch of the GPU.
constexpr std::size_t kBatch = 128;
constexpr std::chrono::seconds kRenewEvery{2};
constexpr std::chrono::milliseconds kLookEvery{200};  // for a job while there is none

std::vector<world::ChunkPos> positionsOf(const world::ChunkArea& area) {
    std::vector<world::ChunkPos> positions;
    for (std::int32_t y = area.y0; y < area.y1; ++y)
        for (std::int32_t x = area.x0; x < area.x1; ++x) positions.push_back({x, y});
    return positions;
}

class Worker {
  public:
    explicit Worker(const WorkerParts& parts) : parts_(parts) {}

    base::Result<WorkerResult> run() {
        const auto number = TERRANE_TRY(parts_.pool.run<std::int64_t>(
            [&](Connection& connection) { return addWorker(connection, parts_.name); }));
        number_ = number;
        auto done = workUntilNoneIsLeft();
        const auto removed =
            parts_.pool.run<void>([&](Connection& connection) { return removeWorker(connection, number_); });
        if (!done) return tl::unexpected(done.error());
        if (!removed) return tl::unexpected(removed.error());
        return result_;
    }

  private:
    base::Result<void> workUntilNoneIsLeft() {
        while (!parts_.stopRequested()) {
            const auto job = TERRANE_TRY(parts_.pool.run<std::optional<Job>>(
                [&](Connection& connection) { return takeJob(connection, number_); }));
            if (job) {
                TERRANE_TRY(make(*job));
                continue;
            }
            const auto isOver = TERRANE_TRY(waitForJob());
            if (isOver) return {};
        }
        return {};
    }

    // True if no job is left; waits while another worker has one, since it may come back.
    base::Result<bool> waitForJob() {
        const auto status = TERRANE_TRY(
            parts_.pool.run<WorkStatus>([](Connection& connection) { return workStatus(connection); }));
        if (!parts_.waits && status.waiting + status.working == 0) return true;
        if (status.isPaused && !std::exchange(saidPaused_, true) && parts_.onPaused) parts_.onPaused();
        if (!status.isPaused) saidPaused_ = false;
        // The pool may run it again.
        const std::int64_t chunks = std::exchange(untold_, 0);
        TERRANE_TRY(parts_.pool.run<void>(
            [&](Connection& connection) { return tellAlive(connection, number_, chunks); }));
        std::this_thread::sleep_for(kLookEvery);
        return false;
    }

    base::Result<void> make(const Job& job) {
        const std::vector<world::ChunkPos> positions = positionsOf(job.area);
        for (std::size_t first = 0; first < positions.size(); first += kBatch) {
            if (parts_.stopRequested()) return parts_.store.flush();
            const auto isOurs = TERRANE_TRY(renewIfDue(job));
            if (!isOurs) return {};
            const std::size_t count = std::min(kBatch, positions.size() - first);
            TERRANE_TRY(makeBatch(std::span(positions).subspan(first, count)));
        }
        TERRANE_TRY(flush(job));
        ++result_.jobs;
        return parts_.pool.run<void>([&](Connection& connection) { return finishJob(connection, job); });
    }

    // Chunks are written while the next ones are generated.
    base::Result<void> makeBatch(std::span<const world::ChunkPos> positions) {
        const std::vector<store::LoadedChunk> stored = parts_.store.loadMany(positions);
        const auto missing = TERRANE_TRY(store::missingChunks(positions, stored));
        auto chunks = TERRANE_TRY(gen::generateAll(parts_.generator, missing));
        for (std::size_t k = 0; k < missing.size(); ++k)
            parts_.store.save(missing[k], std::move(chunks[k]), store::Provenance::Generated);
        const auto made = static_cast<std::int64_t>(missing.size());
        result_.chunks += made;
        result_.skipped += static_cast<std::int64_t>(positions.size()) - made;
        untold_ += made;
        return {};
    }

    // While the database cannot be reached the store retries, and so does this.
    base::Result<void> flush(const Job& job) {
        while (true) {
            auto done = parts_.store.flush();
            if (done && report_.hasEnded(Clock::now())) base::logInfo("saving works again");
            if (done || parts_.stopRequested()) return done;
            if (report_.hasBegun())
                base::logError("{}; the square at {},{} waits", done.error().message, job.area.x0,
                               job.area.y0);
            std::this_thread::sleep_for(kRenewEvery);
        }
    }

    // False if the job is no longer this worker's.
    base::Result<bool> renewIfDue(const Job& job) {
        const Clock::time_point now = Clock::now();
        if (now - renewed_ < kRenewEvery) return true;
        const double seconds = std::chrono::duration<double>(now - renewed_).count();
        renewed_ = now;
        const std::int64_t chunks = std::exchange(untold_, 0);
        // At the first renewal the time spent on the chunks is unknown.
        const double rate = std::exchange(isFirst_, false) ? 0 : static_cast<double>(chunks) / seconds;
        return parts_.pool.run<bool>(
            [&](Connection& connection) { return renewLease(connection, number_, job, chunks, rate); });
    }

    const WorkerParts& parts_;
    std::int64_t number_ = 0;
    WorkerResult result_;
    std::int64_t untold_ = 0;  // chunks not yet reported to the database
    Clock::time_point renewed_{};
    base::FailureReport report_{base::kQuietAfterFailure};  // of flush()
    bool isFirst_ = true, saidPaused_ = false;
};

}  // namespace

base::Result<WorkerResult> work(const WorkerParts& parts) {
    return Worker(parts).run();
}

}  // namespace terrane::store_postgres
