#include "terrane/base/job_system.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

#include "tests/base/failing_memory.h"
#include "tests/base/job_gates.h"

namespace terrane::base {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(JobSystem, RunsWhatIsSubmitted) {
    JobSystem jobs(2);
    int value = 0;
    const JobHandle handle = jobs.submit(0, [&] { value = 7; });
    handle.wait();
    EXPECT_EQ(value, 7);
    EXPECT_EQ(handle.state(), JobState::Done);
    EXPECT_EQ(handle.error(), "");
}

TEST(JobSystem, RunsSmallestPriorityFirstAndTiesInOrder) {
    JobSystem jobs(1);
    std::vector<std::string> order;
    {
        Blocker blocker(jobs);
        const auto add = [&](JobPriority priority, const char* name) {
            jobs.submit(priority, [&order, name] { order.push_back(name); });
        };
        add(5, "five");
        add(1, "one a");
        add(-3, "minus three");
        add(1, "one b");
        add(1, "one c");
        EXPECT_EQ(jobs.queuedCount(), 5u);
    }
    jobs.waitIdle();
    EXPECT_THAT(order, ElementsAre("minus three", "one a", "one b", "one c", "five"));
    EXPECT_EQ(jobs.queuedCount(), 0u);
}

TEST(JobSystem, WithoutThreadsTheCallerRunsTheJobs) {
    JobSystem jobs(0);
    std::vector<int> ran;
    const JobHandle late = jobs.submit(2, [&] { ran.push_back(2); });
    const JobHandle last = jobs.submit(3, [&] { ran.push_back(3); });
    jobs.submit(1, [&] { ran.push_back(1); });
    EXPECT_EQ(jobs.threadCount(), 1u);
    EXPECT_TRUE(ran.empty());
    EXPECT_TRUE(jobs.runNext());
    EXPECT_EQ(ran, (std::vector<int>{1}));
    late.wait();
    EXPECT_EQ(ran, (std::vector<int>{1, 2}));
    EXPECT_EQ(last.state(), JobState::Queued);
    jobs.waitIdle();
    EXPECT_EQ(last.state(), JobState::Done);
    EXPECT_FALSE(jobs.runNext());
    std::vector<int> done(100);
    EXPECT_TRUE(parallelFor(jobs, done.size(), [&](std::size_t k) { done[k] = 1; }));
    EXPECT_EQ(std::count(done.begin(), done.end(), 1), 100);
}

TEST(JobSystem, CancelledQueuedJobNeverStartsAndReleasesItsCapturesAtOnce) {
    JobSystem jobs(1);
    Blocker blocker(jobs);
    auto captured = std::make_shared<int>(1);
    bool ran = false;
    const JobHandle handle = jobs.submit(0, [captured, &ran] { ran = true; });
    EXPECT_EQ(handle.state(), JobState::Queued);
    EXPECT_EQ(captured.use_count(), 2);
    EXPECT_TRUE(handle.cancel());
    EXPECT_EQ(handle.state(), JobState::Cancelled);
    EXPECT_TRUE(handle.cancel());
    EXPECT_EQ(captured.use_count(), 1);
    EXPECT_EQ(jobs.queuedCount(), 0u);
    handle.wait();
    blocker.release();
    jobs.waitIdle();
    EXPECT_FALSE(ran);
}

TEST(JobSystem, CapturesMayCancelAnotherJobWhileTheyAreReleased) {
    struct CancelsOther {
        JobHandle other;
        ~CancelsOther() {
            if (other) other.cancel();
        }
    };
    JobSystem jobs(1);
    Blocker blocker(jobs);
    const JobHandle second = jobs.submit(1, [] {});
    auto canceller = std::make_shared<CancelsOther>();
    canceller->other = second;
    const JobHandle first = jobs.submit(0, [held = std::move(canceller)] {});
    first.cancel();
    EXPECT_EQ(second.state(), JobState::Cancelled);
}

TEST(JobSystem, ARunningJobGoesOnWhenItIsCancelled) {
    JobSystem jobs(1);
    Gate started;
    Gate cancelled;
    const JobHandle handle = jobs.submit(0, [&] {
        started.open();
        cancelled.wait();
    });
    started.wait();
    EXPECT_FALSE(handle.cancel());
    EXPECT_EQ(handle.state(), JobState::Running);
    cancelled.open();
    handle.wait();
    EXPECT_EQ(handle.state(), JobState::Done);
}

TEST(JobSystem, CancellingAFinishedJobChangesNothing) {
    JobSystem jobs(1);
    const JobHandle handle = jobs.submit(0, [] {});
    handle.wait();
    handle.cancel();
    EXPECT_EQ(handle.state(), JobState::Done);
}

TEST(JobSystem, ReportsWhatAJobThrows) {
    testing::internal::CaptureStderr();
    {
        JobSystem jobs(1);
        const JobHandle known = jobs.submit(0, [] { throw std::runtime_error("no such chunk"); });
        const JobHandle unknown = jobs.submit(0, [] { throw 3; });
        known.wait();
        unknown.wait();
        EXPECT_EQ(known.state(), JobState::Failed);
        EXPECT_EQ(known.error(), "no such chunk");
        EXPECT_EQ(unknown.state(), JobState::Failed);
        EXPECT_THAT(unknown.error(), HasSubstr("not a std::exception"));
        const JobHandle after = jobs.submit(0, [] {});
        after.wait();
        EXPECT_EQ(after.state(), JobState::Done) << "the worker survives";
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "failures that were asked for are not logged";
}

TEST(JobSystem, LogsAFailureNobodyAskedForOnce) {
    testing::internal::CaptureStderr();
    {
        JobSystem jobs(2);
        const JobHandle kept = jobs.submit(0, [] { throw std::runtime_error("kept"); });
        const JobHandle copy = kept;
        jobs.submit(0, [] { throw std::runtime_error("dropped"); });
        jobs.waitIdle();
    }
    const std::string kept = "terrane: error: a job failed: kept\n";
    const std::string dropped = "terrane: error: a job failed: dropped\n";
    EXPECT_THAT(testing::internal::GetCapturedStderr(), AnyOf(kept + dropped, dropped + kept));
}

TEST(JobSystem, ReleasesCapturesBeforeAJobCountsAsFinished) {
    JobSystem jobs(1);
    auto captured = std::make_shared<int>(1);
    const JobHandle handle = jobs.submit(0, [captured] {});
    handle.wait();
    EXPECT_EQ(captured.use_count(), 1);
}

TEST(JobSystem, DestructionCancelsQueuedJobsAndFinishesRunningOnes) {
    struct OpensGate {
        Gate& gate;
        explicit OpensGate(Gate& opened) : gate(opened) {}
        ~OpensGate() { gate.open(); }
    };
    Gate started;
    Gate queuedReleased;  // opened by the captures of the queued job
    JobHandle running;
    JobHandle queued;
    JobHandle late;
    bool queuedRan = false;
    {
        JobSystem jobs(1);
        running = jobs.submit(0, [&] {
            started.open();
            queuedReleased.wait();
            late = jobs.submit(0, [] {});
        });
        queued =
            jobs.submit(1, [&, opens = std::make_shared<OpensGate>(queuedReleased)] { queuedRan = true; });
        started.wait();
    }
    EXPECT_EQ(running.state(), JobState::Done);
    EXPECT_EQ(queued.state(), JobState::Cancelled);
    EXPECT_EQ(late.state(), JobState::Cancelled);
    EXPECT_FALSE(queuedRan);
    queued.wait();
    late.wait();
}

TEST(JobSystem, HandlesOutliveTheSystem) {
    JobHandle handle;
    EXPECT_FALSE(handle);
    {
        JobSystem jobs(1);
        handle = jobs.submit(0, [] {});
        handle.wait();
    }
    EXPECT_TRUE(handle);
    handle.wait();
    EXPECT_EQ(handle.state(), JobState::Done);
}

TEST(JobSystem, WaitIdleReturnsAtOnceWithoutJobs) {
    JobSystem jobs(3);
    jobs.waitIdle();
    EXPECT_EQ(jobs.threadCount(), 3u);
}

TEST(JobSystem, WaitIdleSeesTheLastQueuedJobCancelled) {
    JobSystem jobs(1);
    std::vector<JobHandle> handles;
    {
        Blocker blocker(jobs);
        for (int i = 0; i < 10; ++i) handles.push_back(jobs.submit(i, [] {}));
        for (const JobHandle& handle : handles) handle.cancel();
    }
    jobs.waitIdle();
    for (const JobHandle& handle : handles) EXPECT_EQ(handle.state(), JobState::Cancelled);
}

TEST(JobSystem, JobsMaySubmitJobs) {
    JobSystem jobs(2);
    std::atomic<int> ranCount{0};
    jobs.submit(0, [&] {
        for (int i = 0; i < 5; ++i) jobs.submit(i, [&] { ++ranCount; });
    });
    jobs.waitIdle();
    EXPECT_EQ(ranCount, 5);
}

TEST(JobSystem, ManyThreadsSubmitCancelAndWait) {
    constexpr int kThreads = 4;
    constexpr int kJobsPerThread = 2500;
    JobSystem jobs(4);
    std::atomic<int> ranCount{0};
    std::atomic<int> cancelledCount{0};
    const auto submitAll = [&](int seed) {
        std::vector<JobHandle> handles;
        for (int i = 0; i < kJobsPerThread; ++i) {
            handles.push_back(jobs.submit((i * 7919 + seed) % 101, [&] { ++ranCount; }));
            if (i % 3 == 0) handles[static_cast<std::size_t>(i / 2)].cancel();
        }
        for (const JobHandle& handle : handles) {
            handle.wait();
            EXPECT_TRUE(handle.state() == JobState::Done || handle.state() == JobState::Cancelled);
            if (handle.state() == JobState::Cancelled) ++cancelledCount;
        }
    };
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t) threads.emplace_back(submitAll, t);
    for (std::thread& thread : threads) thread.join();
    jobs.waitIdle();
    EXPECT_EQ(ranCount + cancelledCount, kThreads * kJobsPerThread);
}

TEST(JobSystem, RunsTenThousandJobs) {
    constexpr std::size_t kJobs = 10000;
    JobSystem jobs(4);
    std::vector<int> ran(kJobs, 0);
    for (std::size_t i = 0; i < kJobs; ++i) jobs.submit(0, [&ran, i] { ++ran[i]; });
    jobs.waitIdle();
    EXPECT_THAT(ran, testing::Each(1));
}

TEST(JobSystemDeathTest, WaitingOnAWorkerEndsWithAReason) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    const auto waitInside = [] {
        JobSystem jobs(1);
        JobHandle never;
        jobs.submit(0, [&] {
            never = jobs.submit(0, [] {});
            never.wait();
        });
        jobs.waitIdle();
    };
    EXPECT_DEATH(waitInside(), "wait was called on a worker");
    const auto idleInside = [] {
        JobSystem jobs(1);
        jobs.submit(0, [&] { jobs.waitIdle(); });
        jobs.waitIdle();
    };
    EXPECT_DEATH(idleInside(), "waitIdle was called on a worker");
}

TEST(JobSystem, AWorkerMayWaitForAnotherSystem) {
    JobSystem outer(1);
    JobSystem inner(1);
    int value = 0;
    outer.submit(0, [&] { inner.submit(0, [&] { value = 3; }).wait(); });
    outer.waitIdle();
    EXPECT_EQ(value, 3);
}

// Wherever memory runs out, the constructor throws, or the system works with fewer threads.
TEST(JobSystem, WithoutMemoryItHasFewerThreads) {
    if (!FailingMemory::isPossible()) GTEST_SKIP() << "memory cannot be made to fail here";
    int started = 0, refused = 0, withFewer = 0;
    std::size_t last = 0;
    for (long n = 0; started == 0 || FailingMemory::hasFailed(); ++n) {
        std::optional<JobSystem> jobs;
        try {
            const FailingMemory memory(n);
            jobs.emplace(4);
        } catch (const std::exception&) {
            ++refused;
            continue;
        }
        ++started;
        last = jobs->threadCount();
        EXPECT_GE(last, 1u);
        withFewer += last < 4;
        std::atomic<int> calls = 0;
        EXPECT_TRUE(parallelFor(*jobs, 20, [&](std::size_t) { ++calls; }));
        EXPECT_EQ(calls, 20);
    }
    EXPECT_GT(refused, 1);
    EXPECT_GT(withFewer, 0);
    EXPECT_EQ(last, 4u) << "where memory is enough";
}

TEST(JobSystem, EndsWithoutMemory) {
    std::atomic<bool> isReleased = false;
    JobHandle queued;
    {
        std::optional<JobSystem> jobs(1);
        std::atomic<bool> isRunning = false;
        jobs->submit(0, [&] {
            for (isRunning = true; !isReleased;) std::this_thread::yield();
        });
        while (!isRunning) std::this_thread::yield();
        std::shared_ptr<bool> captured(new bool, [&](const bool* value) {
            delete value;
            isReleased = true;
        });
        queued = jobs->submit(0, [held = std::move(captured)] {});
        const FailingMemory memory(0);
        jobs.reset();
    }
    EXPECT_TRUE(isReleased);
    EXPECT_EQ(queued.state(), JobState::Cancelled);
}

TEST(JobSystem, AJobWithoutMemoryFails) {
    JobSystem jobs(1);
    for (long n = 0; n < 100; ++n) {
        const JobHandle job = jobs.submit(0, [&] {
            const FailingMemory memory(n, LONG_MAX);
            throw std::runtime_error("a message that needs memory of its own");
        });
        job.wait();
        EXPECT_EQ(job.state(), JobState::Failed);
        EXPECT_FALSE(job.error().empty());
    }
}

TEST(JobSystem, AnEmptyHandleAndEmptyWorkAreRefused) {
    const JobHandle handle;
    EXPECT_THROW((void)handle.state(), std::invalid_argument);
    EXPECT_THROW((void)handle.cancel(), std::invalid_argument);
    EXPECT_THROW(handle.wait(), std::invalid_argument);
    EXPECT_THROW((void)handle.error(), std::invalid_argument);
    JobSystem jobs(0);
    EXPECT_THROW((void)jobs.submit({}, nullptr), std::invalid_argument);
    EXPECT_THROW((void)parallelFor(jobs, 3, nullptr), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::base
