#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <climits>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "terrane/base/job_system.h"
#include "tests/base/failing_memory.h"
#include "tests/base/job_gates.h"

namespace terrane::base {
namespace {

TEST(ParallelFor, CallsEachIndexOnce) {
    JobSystem jobs(4);
    for (const std::size_t count : {0u, 1u, 2u, 3u, 1000u}) {
        std::vector<int> calls(count, 0);
        EXPECT_TRUE(parallelFor(jobs, count, [&](std::size_t i) { ++calls[i]; }));
        EXPECT_THAT(calls, testing::Each(1)) << count;
    }
    EXPECT_EQ(jobs.queuedCount(), 0u);
}

TEST(ParallelFor, TheCallerDoesAllWhenTheWorkersAreBusy) {
    JobSystem jobs(1);
    Blocker blocker(jobs);
    const std::thread::id self = std::this_thread::get_id();
    std::size_t ranHere = 0;
    EXPECT_TRUE(parallelFor(jobs, 20, [&](std::size_t) { ranHere += std::this_thread::get_id() == self; }));
    EXPECT_EQ(ranHere, 20u);
    EXPECT_EQ(jobs.queuedCount(), 0u) << "helpers that never started are gone";
}

TEST(ParallelFor, WorkersHelp) {
    JobSystem jobs(1);
    Gate bothInside;
    std::atomic<int> insideCount{0};
    // Two indices that wait for each other finish only on two threads.
    EXPECT_TRUE(parallelFor(jobs, 2, [&](std::size_t) {
        if (++insideCount == 2) bothInside.open();
        bothInside.wait();
    }));
}

TEST(ParallelFor, ReportsTheLowestFailingIndexAfterRunningAll) {
    JobSystem jobs(4);
    for (int round = 0; round < 20; ++round) {
        std::atomic<int> callCount{0};
        const Result<void> result = parallelFor(jobs, 100, [&](std::size_t i) {
            ++callCount;
            if (i % 30 == 17) throw std::runtime_error("bad " + std::to_string(i));
        });
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().message, "index 17 of 100: bad 17");
        EXPECT_EQ(callCount, 100);
    }
}

TEST(ParallelFor, WorksOnWorkersAndNested) {
    JobSystem jobs(2);
    std::atomic<int> callCount{0};
    const JobHandle handle = jobs.submit(0, [&] {
        const Result<void> outer = parallelFor(jobs, 8, [&](std::size_t) {
            const Result<void> inner = parallelFor(jobs, 8, [&](std::size_t) { ++callCount; });
            EXPECT_TRUE(inner);
        });
        EXPECT_TRUE(outer);
    });
    handle.wait();
    EXPECT_EQ(callCount, 64);
}

// Wherever memory runs out: the call returns or throws, and works again afterwards.
TEST(ParallelFor, WithoutMemoryNobodyWaitsForEver) {
    if (!FailingMemory::isPossible()) GTEST_SKIP() << "memory cannot be made to fail here";
    JobSystem jobs(2);
    long n = 0;
    for (; n < 2000; ++n) {
        bool hasFailed = false;
        for (const long count : {1L, LONG_MAX}) {
            std::atomic<int> calls = 0;
            try {
                const FailingMemory memory(n, count);
                const Result<void> done = parallelFor(jobs, 20, [&](std::size_t i) {
                    ++calls;
                    if (i % 3 == 1) throw std::runtime_error("a message that needs memory of its own");
                });
                EXPECT_FALSE(done);
                EXPECT_EQ(calls, 20);
            } catch (const std::bad_alloc&) {
            }
            hasFailed = hasFailed || FailingMemory::hasFailed();
            jobs.waitIdle();
            EXPECT_TRUE(parallelFor(jobs, 20, [](std::size_t) {}));
        }
        if (!hasFailed) break;
    }
    EXPECT_GT(n, 10);
    EXPECT_LT(n, 2000) << "in the end memory is enough";
}

}  // namespace
}  // namespace terrane::base
