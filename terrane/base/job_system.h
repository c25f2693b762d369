// Runs work on a fixed set of threads, most urgent first. Streaming, meshing and the generators submit to it.
//
// Any thread, workers included, may submit, cancel and query states. Only other threads may wait for a job: a
// worker could wait for a job that only it can run, so waiting on a worker aborts the program with a message.
// parallelFor is safe everywhere.
#pragma once

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
    Cancelled,  // never started
    Failed,     // threw; JobHandle::error has the message
};

using JobWork = std::function<void()>;

// Refers to one submitted job. Copies refer to the same job; destroying all handles neither cancels the job
// nor waits for it. A handle may outlive its system. A default-constructed handle refers to no job and tests
// false.
class JobHandle {
  public:
    JobHandle() = default;

    [[nodiscard]] explicit operator bool() const { return job_ != nullptr; }

    // Returns the job's state. If it is Done, everything that the job wrote is visible to the calling thread.
    [[nodiscard]] JobState state() const;

    // Cancels the job if it is queued: it never starts and has released its captures when this returns. Other
    // jobs stay as they are. Returns whether the job is Cancelled.
    bool cancel() const;

    // Blocks until the job is Done, Cancelled or Failed. It must not be called on a worker of the same
    // system.
    void wait() const;

    // Returns the message of the exception that the job threw; the text is empty unless the job Failed. A
    // failure is logged unless this is called before the last handle is destroyed.
    [[nodiscard]] std::string error() const;

  private:
    friend class JobSystem;
    explicit JobHandle(std::shared_ptr<detail::Job> job) : job_(std::move(job)) {}

    std::shared_ptr<detail::Job> job_;
};

class JobSystem {
  public:
    // With 0 threads, jobs run only in runNext() or while the caller waits, so that tests control when. If
    // the system cannot start all threads, fewer do the work; throws if it cannot start any.
    explicit JobSystem(unsigned threadCount);
    ~JobSystem();  // cancels queued jobs, lets running ones finish; jobs submitted meanwhile come back
                   // Cancelled
    JobSystem(const JobSystem&) = delete;
    JobSystem& operator=(const JobSystem&) = delete;

    JobHandle submit(JobPriority priority, JobWork work);

    // Runs the most urgent job on the calling thread. Returns false if none is queued.
    bool runNext();
    // Does the same for a system with 0 threads; returns false if the system has threads. Code that waits for
    // results of jobs calls it.
    bool runNextWithoutThreads() { return workers_.empty() && runNext(); }

    // Returns the number of jobs that run at a time.
    [[nodiscard]] unsigned threadCount() const {
        return workers_.empty() ? 1 : static_cast<unsigned>(workers_.size());
    }
    [[nodiscard]] std::size_t queuedCount() const;  // submitted and not started

    // Blocks until nothing is queued or running. It must not be called on a worker of this system.
    void waitIdle();

  private:
    std::shared_ptr<detail::JobQueue> queue_;  // shared with the handles
    std::vector<std::thread> workers_;
};

// Calls body(0) … body(count - 1) once each, on the workers and the calling thread, and returns when all have
// finished. The work runs before all other queued jobs, since the caller is blocked. Every index runs even if
// one throws; the error is that of the lowest index that threw, so the result does not depend on the order of
// threads. One index should take more than about a microsecond: each costs an atomic addition.
[[nodiscard]] Result<void> parallelFor(JobSystem& jobs, std::size_t count,
                                       const std::function<void(std::size_t)>& body);

}  // namespace terrane::base
