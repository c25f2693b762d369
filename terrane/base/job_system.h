// Runs work on a fixed set of threads, most urgent first. Streaming, meshing and the generators submit to it.
//
// Any thread may submit, cancel and ask for a state, the workers included. Waiting for a job is for other
// threads: a worker that waits may wait for something that only it could run, so that ends the program with
// the reason. parallelFor is safe everywhere.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::base {

namespace detail {
struct Job;
struct JobQueue;
}  // namespace detail

using JobPriority = std::int64_t;  // the smaller runs first; equal ones run in the order of submission

enum class JobState {
    Queued,
    Running,
    Done,
    Cancelled,  // never started, or was asked to stop while it ran
    Failed,     // threw; JobHandle::error has the message
};

// Asks running work to stop. Work looks at it between steps and returns early; nothing is interrupted.
class CancelToken {
  public:
    CancelToken() = default;
    CancelToken(const CancelToken&) = delete;
    CancelToken& operator=(const CancelToken&) = delete;

    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool isCancelled() const { return cancelled_.load(std::memory_order_relaxed); }

  private:
    std::atomic<bool> cancelled_{false};
};

using JobWork = std::function<void(const CancelToken&)>;

// Names one submitted job. Copies name the same job; dropping every handle neither cancels nor waits. A
// handle may outlive its system. A default-made handle names no job and only tests false.
class JobHandle {
  public:
    JobHandle() = default;

    [[nodiscard]] explicit operator bool() const { return job_ != nullptr; }

    // Seeing Done here also makes everything the job wrote visible to the calling thread.
    [[nodiscard]] JobState state() const;

    // A queued job never starts and has released its captures when this returns. A running one sees its token
    // set and ends Cancelled (Failed if it throws). A finished one stays as it is.
    void cancel() const;

    // Blocks until the job is Done, Cancelled or Failed. Not on a worker of the same system.
    void wait() const;

    // The message of what the job threw; empty unless Failed. A failure that nobody asks for before the last
    // handle is gone is logged.
    [[nodiscard]] std::string error() const;

  private:
    friend class JobSystem;
    explicit JobHandle(std::shared_ptr<detail::Job> job) : job_(std::move(job)) {}

    std::shared_ptr<detail::Job> job_;
};

class JobSystem {
  public:
    // Without threads jobs run when the caller says so, by runNext() or by waiting: tests decide when. Where
    // the system cannot start that many, those that it can do the work; an exception where it starts none.
    explicit JobSystem(unsigned threadCount);
    ~JobSystem();  // cancels queued jobs, lets running ones finish; jobs submitted meanwhile come back
                   // Cancelled
    JobSystem(const JobSystem&) = delete;
    JobSystem& operator=(const JobSystem&) = delete;

    JobHandle submit(JobPriority priority, JobWork work);

    // Runs the most urgent job on the calling thread. False where none is queued.
    bool runNext();

    // How many jobs run at a time.
    [[nodiscard]] unsigned threadCount() const {
        return workers_.empty() ? 1 : static_cast<unsigned>(workers_.size());
    }
    [[nodiscard]] std::size_t queuedCount() const;  // submitted and not started

    // Blocks until nothing is queued or running. Not on a worker of this system.
    void waitIdle();

  private:
    std::shared_ptr<detail::JobQueue> queue_;  // shared with the handles
    std::vector<std::thread> workers_;
};

// Calls body(0) … body(count - 1) once each, on the workers and the calling thread, and returns when all have
// finished. Goes before every other queued job, since its caller stands still. Every index runs even after
// one has thrown, and the error is that of the lowest index, so the result does not depend on the order of
// threads. One index should be worth more than about a microsecond: each costs an atomic addition.
[[nodiscard]] Result<void> parallelFor(JobSystem& jobs, std::size_t count,
                                       const std::function<void(std::size_t)>& body);

}  // namespace terrane::base
