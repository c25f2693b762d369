#include "terrane/base/job_system.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"
#include "terrane/base/result.h"

namespace terrane::base {

namespace detail {

struct QueueKey {
    JobPriority priority = 0;
    std::uint64_t sequence = 0;  // order of submission

    auto operator<=>(const QueueKey&) const = default;
};

// One lock for the queue and the states of its jobs: jobs last far longer than it is held.
struct JobQueue {
    mutable std::mutex mutex;
    std::condition_variable workAdded;
    std::condition_variable becameIdle;
    std::map<QueueKey, std::shared_ptr<Job>> queued;  // a map, so that a cancelled job leaves at once
    std::uint64_t nextSequence = 0;
    std::size_t runningCount = 0;
    bool stopping = false;
    bool hasNoThreads = false;               // waiting threads run the jobs
    std::vector<std::thread::id> workerIds;  // complete before the first job is submitted

    [[nodiscard]] bool isIdle() const { return queued.empty() && runningCount == 0; }
};

struct Job {
    std::shared_ptr<JobQueue> queue;
    QueueKey key;
    JobWork work;  // guarded by queue->mutex while queued, then the worker's alone
    std::atomic<JobState> state{JobState::Queued};  // changes only under queue->mutex
    std::string error;                              // constant once the state is Failed
    std::atomic<bool> errorSeen{false};
    std::condition_variable finished;

    Job(std::shared_ptr<JobQueue> owner, JobWork todo) : queue(std::move(owner)), work(std::move(todo)) {}
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;
    ~Job() {
        if (state == JobState::Failed && !errorSeen) logError("a job failed: {}", error);
    }
};

}  // namespace detail

namespace {

using detail::Job;
using detail::JobQueue;

// Helpers of parallelFor run before all other jobs.
constexpr JobPriority kMostUrgent = std::numeric_limits<JobPriority>::min();

bool isFinished(JobState state) {
    return state != JobState::Queued && state != JobState::Running;
}

// Checked in release builds too: otherwise the program would hang without a message.
void forbidOnWorker(const JobQueue& queue, const char* reason) {
    {
        const std::lock_guard lock(queue.mutex);
        const auto self =
            std::find(queue.workerIds.begin(), queue.workerIds.end(), std::this_thread::get_id());
        if (self == queue.workerIds.end()) return;
    }
    logError("{}", reason);
    std::abort();
}

// A copy of the text, or a short text that needs no memory if the allocation fails.
std::string copyOf(const char* text) noexcept {
    try {
        return text;
    } catch (const std::bad_alloc&) {
        return "no memory";
    }
}

// The message of the exception that `call` threw, or nothing. Never throws: an exception would leave other
// threads waiting.
template <class Call>
std::optional<std::string> errorOf(const Call& call) noexcept {
    try {
        call();
        return std::nullopt;
    } catch (const std::exception& exception) {
        return copyOf(textOf(exception));
    } catch (...) {
        return copyOf("an exception that is not a std::exception");
    }
}

// The most urgent job, now Running. Needs the lock and a queue that is not empty.
std::shared_ptr<Job> popMostUrgent(JobQueue& queue) {
    std::shared_ptr<Job> job = std::move(queue.queued.begin()->second);
    queue.queued.erase(queue.queued.begin());
    assert(job->state == JobState::Queued && "only queued jobs are in the queue");
    job->state = JobState::Running;
    ++queue.runningCount;
    return job;
}

// Blocks until a job is queued and takes the most urgent one; null when the system stops.
std::shared_ptr<Job> takeJob(JobQueue& queue) {
    std::unique_lock lock(queue.mutex);
    queue.workAdded.wait(lock, [&] { return queue.stopping || !queue.queued.empty(); });
    return queue.stopping ? nullptr : popMostUrgent(queue);
}

void runJob(Job& job) {
    JobQueue& queue = *job.queue;
    std::optional<std::string> error = errorOf([&] { job.work(); });
    job.work = nullptr;  // captures are released before the job counts as finished
    bool idle = false;
    {
        const std::lock_guard lock(queue.mutex);
        assert(queue.runningCount > 0 && "a running job is counted from start to end");
        --queue.runningCount;
        idle = queue.isIdle();
        if (error) {
            job.error = std::move(*error);
            job.state = JobState::Failed;
        } else {
            job.state = JobState::Done;
        }
    }
    job.finished.notify_all();
    if (idle) queue.becameIdle.notify_all();
}

// Cancels queued jobs and all jobs submitted from now on, and lets the workers end. Allocates no memory.
void stopQueue(JobQueue& queue) {
    std::map<detail::QueueKey, std::shared_ptr<Job>> cancelled;
    {
        const std::lock_guard lock(queue.mutex);
        queue.stopping = true;
        cancelled.swap(queue.queued);
        for (const auto& [key, job] : cancelled) job->state = JobState::Cancelled;
    }
    // Outside of the lock, as in JobHandle::cancel. No other thread accesses the work of a cancelled job.
    for (const auto& [key, job] : cancelled) job->work = nullptr;
    queue.workAdded.notify_all();
    for (const auto& [key, job] : cancelled) job->finished.notify_all();
}

bool runFirst(JobQueue& queue) {
    std::shared_ptr<Job> job;
    {
        const std::lock_guard lock(queue.mutex);
        if (queue.queued.empty()) return false;
        job = popMostUrgent(queue);
    }
    runJob(*job);
    return true;
}

void runWorker(JobQueue& queue, unsigned number) {
    // The thread stays unnamed if there is no memory for its name.
    static_cast<void>(errorOf([&] { setThreadName(fmt::format("worker {}", number)); }));
    while (const std::shared_ptr<Job> job = takeJob(queue)) runJob(*job);
}

}  // namespace

JobState JobHandle::state() const {
    require(job_ != nullptr, "JobHandle::state: an empty handle");
    return job_->state.load(std::memory_order_acquire);
}

bool JobHandle::cancel() const {
    require(job_ != nullptr, "JobHandle::cancel: an empty handle");
    JobQueue& queue = *job_->queue;
    JobWork released;  // outlives the lock: destroying captures may run anything, even another cancel
    bool idle = false;
    {
        const std::lock_guard lock(queue.mutex);
        if (job_->state != JobState::Queued) return job_->state == JobState::Cancelled;
        queue.queued.erase(job_->key);
        released = std::exchange(job_->work, nullptr);
        job_->state = JobState::Cancelled;
        idle = queue.isIdle();
    }
    job_->finished.notify_all();
    if (idle) queue.becameIdle.notify_all();
    return true;
}

void JobHandle::wait() const {
    require(job_ != nullptr, "JobHandle::wait: an empty handle");
    forbidOnWorker(*job_->queue, "JobHandle::wait was called on a worker, which could wait for itself");
    if (job_->queue->hasNoThreads)
        while (!isFinished(job_->state) && runFirst(*job_->queue)) continue;
    std::unique_lock lock(job_->queue->mutex);
    job_->finished.wait(lock, [&] { return isFinished(job_->state); });
}

std::string JobHandle::error() const {
    require(job_ != nullptr, "JobHandle::error: an empty handle");
    if (state() != JobState::Failed) return {};
    job_->errorSeen = true;
    return job_->error;
}

JobSystem::JobSystem(unsigned threadCount) : queue_(std::make_shared<JobQueue>()) {
    queue_->hasNoThreads = threadCount == 0;
    workers_.reserve(threadCount);
    const std::lock_guard lock(queue_->mutex);
    queue_->workerIds.reserve(threadCount);
    const std::optional<std::string> error = errorOf([&] {
        for (unsigned number = 1; number <= threadCount; ++number) {
            workers_.emplace_back([queue = queue_.get(), number] { runWorker(*queue, number); });
            queue_->workerIds.push_back(workers_.back().get_id());
        }
    });
    if (error && workers_.empty()) throw std::runtime_error(*error);
}

JobSystem::~JobSystem() {
    forbidOnWorker(*queue_, "a job system was destroyed on its own worker, which cannot join itself");
    stopQueue(*queue_);
    for (std::thread& worker : workers_) worker.join();
    assert(queue_->isIdle() && "after the workers have ended nothing is queued or running");
}

JobHandle JobSystem::submit(JobPriority priority, JobWork work) {
    require(work != nullptr, "JobSystem::submit: a job needs work to do");
    auto job = std::make_shared<Job>(queue_, std::move(work));
    {
        const std::lock_guard lock(queue_->mutex);
        if (!queue_->stopping) {
            job->key = {priority, queue_->nextSequence++};
            queue_->queued.emplace(job->key, job);
        } else {
            job->state = JobState::Cancelled;
        }
    }
    if (job->state == JobState::Cancelled) job->work = nullptr;
    queue_->workAdded.notify_one();
    return JobHandle(std::move(job));
}

std::size_t JobSystem::queuedCount() const {
    const std::lock_guard lock(queue_->mutex);
    return queue_->queued.size();
}

bool JobSystem::runNext() {
    return runFirst(*queue_);
}

void JobSystem::waitIdle() {
    forbidOnWorker(*queue_, "JobSystem::waitIdle was called on a worker, which would wait for itself");
    while (queue_->hasNoThreads && runNext()) continue;
    std::unique_lock lock(queue_->mutex);
    queue_->becameIdle.wait(lock, [&] { return queue_->isIdle(); });
}

namespace {

// Shared by the caller of parallelFor and its helpers. Helpers that start late find no index left and touch
// nothing but this, so the caller need not wait for them.
struct Loop {
    const std::function<void(std::size_t)>& body;  // valid until every index has finished
    const std::size_t count;
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::condition_variable allFinished;
    std::size_t finishedCount = 0;
    std::size_t failedIndex = std::numeric_limits<std::size_t>::max();  // the lowest that threw
    std::string error;                                                  // its message

    Loop(const std::function<void(std::size_t)>& loopBody, std::size_t n) : body(loopBody), count(n) {}
};

void runIndices(Loop& loop) {
    std::size_t ranCount = 0;
    for (std::size_t index = loop.next++; index < loop.count; index = loop.next++) {
        if (std::optional<std::string> error = errorOf([&] { loop.body(index); })) {
            const std::lock_guard lock(loop.mutex);
            if (index < loop.failedIndex) {
                loop.failedIndex = index;
                loop.error = std::move(*error);
            }
        }
        ++ranCount;
    }
    if (ranCount == 0) return;
    const std::lock_guard lock(loop.mutex);
    loop.finishedCount += ranCount;
    assert(loop.finishedCount <= loop.count && "each index runs once");
    if (loop.finishedCount == loop.count) loop.allFinished.notify_all();
}

}  // namespace

Result<void> parallelFor(JobSystem& jobs, std::size_t count, const std::function<void(std::size_t)>& body) {
    require(body != nullptr, "parallelFor: nothing to call");
    if (count == 0) return {};
    const auto loop = std::make_shared<Loop>(body, count);
    std::vector<JobHandle> helpers(std::min<std::size_t>(jobs.threadCount(), count - 1));
    std::size_t helperCount = 0;
    // Helpers that cannot be submitted for lack of memory are left out.
    static_cast<void>(errorOf([&] {
        for (; helperCount < helpers.size(); ++helperCount)
            helpers[helperCount] = jobs.submit(kMostUrgent, [loop] { runIndices(*loop); });
    }));
    runIndices(*loop);
    for (std::size_t k = 0; k < helperCount; ++k) helpers[k].cancel();  // those that did not start
    std::unique_lock lock(loop->mutex);
    loop->allFinished.wait(lock, [&] { return loop->finishedCount == loop->count; });
    if (loop->failedIndex < count) return fail("index {} of {}: {}", loop->failedIndex, count, loop->error);
    return {};
}

}  // namespace terrane::base
