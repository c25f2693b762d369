#include "terrane/store/save_queue.h"

#include <atomic>
#include <functional>

#include "tests/base/wait_until.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using namespace std::chrono_literals;

struct Recorder {
    std::mutex mutex;
    std::vector<SaveBatch> batches;
    std::string problem;  // error returned by writing

    SaveQueue::WriteBatch write() {
        return [this](const SaveBatch& batch) -> base::Result<void> {
            const std::lock_guard lock(mutex);
            if (!problem.empty()) return base::fail("{}", problem);
            batches.push_back(batch);
            return {};
        };
    }
    void fail(std::string with) {
        const std::lock_guard lock(mutex);
        problem = std::move(with);
    }
};

// Out of memory while writing: nothing is lost and the program continues.
TEST(SaveQueue, WhatThrowsStaysAndIsTriedAgain) {
    int attempts = 0;
    Recorder recorder;
    const auto older = numberedChunk(1), newer = numberedChunk(2);
    SaveQueue queue(
        [&](const SaveBatch& batch) -> base::Result<void> {
            if (++attempts == 1) throw std::bad_alloc();
            if (attempts == 2) throw std::runtime_error("not now");
            return recorder.write()(batch);
        },
        kNever);
    queue.add({1, 2}, {older, Provenance::Edited});
    queue.add({3, 4}, {older, Provenance::Edited});
    queue.add("time", "0.5");
    EXPECT_EQ(queue.flush().error().message, "no memory");
    queue.add({1, 2}, {newer, Provenance::Edited});
    queue.add({3, 4}, {newer, Provenance::Generated});
    queue.add("time", "0.6");
    EXPECT_EQ(queue.flush().error().message, "not now");
    ASSERT_TRUE(queue.flush());
    ASSERT_EQ(recorder.batches.size(), 1u);
    EXPECT_EQ(recorder.batches[0].chunks.at({1, 2}).chunk, newer);
    EXPECT_EQ(recorder.batches[0].chunks.at({3, 4}).chunk, older)
        << "a generated chunk replaces no edited one";
    EXPECT_EQ(recorder.batches[0].metadata.at("time"), "0.6");
}

TEST(SaveQueue, FlushWritesOneBatchWithTheNewest) {
    Recorder recorder;
    SaveQueue queue(recorder.write(), kNever);
    const auto older = numberedChunk(1), newer = numberedChunk(2);
    EXPECT_EQ(queue.add({1, 2}, {older, Provenance::Edited}), 1u);
    EXPECT_EQ(queue.add({1, 2}, {newer, Provenance::Edited}), 2u);
    EXPECT_EQ(queue.add({3, 4}, {older, Provenance::Generated}), 3u);
    EXPECT_EQ(queue.add("time", "0.5"), 4u);
    EXPECT_EQ(queue.status().durable, 0u);
    EXPECT_EQ(queue.status().waiting, 2u);
    EXPECT_EQ(queue.find({1, 2})->chunk, newer);
    EXPECT_FALSE(queue.find({9, 9}));

    ASSERT_TRUE(queue.flush());
    EXPECT_EQ(queue.status().durable, 4u);
    EXPECT_EQ(queue.status().waiting, 0u);
    EXPECT_FALSE(queue.find({1, 2})) << "in the file now";
    ASSERT_EQ(recorder.batches.size(), 1u);
    EXPECT_EQ(recorder.batches[0].chunks.at({1, 2}).chunk, newer);
    EXPECT_EQ(recorder.batches[0].chunks.size(), 2u);
    EXPECT_EQ(recorder.batches[0].metadata.at("time"), "0.5");
    ASSERT_TRUE(queue.flush());
    EXPECT_EQ(recorder.batches.size(), 1u) << "nothing to write";
}

TEST(SaveQueue, GeneratedNeverReplacesEdited) {
    Recorder recorder;
    SaveQueue queue(recorder.write(), kNever);
    const auto edited = numberedChunk(1);
    queue.add({0, 0}, {edited, Provenance::Edited});
    queue.add({0, 0}, {numberedChunk(2), Provenance::Generated});
    EXPECT_EQ(queue.find({0, 0})->chunk, edited);
}

TEST(SaveQueue, WritesAfterTheDelayAndWhenThereIsMuch) {
    Recorder recorder;
    {
        SaveQueue queue(recorder.write(), {.delay = 20ms, .chunks = 1000});
        queue.add({0, 0}, {numberedChunk(1), Provenance::Edited});
        ASSERT_TRUE(base::waitUntil([&] { return queue.status().durable >= 1; }));
    }
    EXPECT_EQ(recorder.batches.size(), 1u);
    SaveQueue queue(recorder.write(), {.delay = 1h, .chunks = 3});
    for (int x = 0; x < 3; ++x) queue.add({x, 0}, {numberedChunk(x), Provenance::Edited});
    ASSERT_TRUE(base::waitUntil([&] { return queue.status().durable >= 3; }));
    EXPECT_EQ(recorder.batches.size(), 2u);
}

TEST(SaveQueue, TheEndWritesWhatWaits) {
    Recorder recorder;
    {
        SaveQueue queue(recorder.write(), kNever);
        queue.add({0, 0}, {numberedChunk(1), Provenance::Edited});
    }
    EXPECT_EQ(recorder.batches.size(), 1u);
}

// As with a full disk: nothing is lost, nothing counts as durable, and it recovers when there is space.
TEST(SaveQueue, WhatFailedStaysAndIsTriedAgain) {
    Recorder recorder;
    SaveQueue queue(recorder.write(), kNever);
    recorder.fail("a.sqlite: the disk is full");
    queue.add({0, 0}, {numberedChunk(1), Provenance::Edited});
    queue.add({1, 0}, {numberedChunk(2), Provenance::Edited});
    const auto failed = queue.flush();
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "a.sqlite: the disk is full");
    EXPECT_EQ(queue.status().problem, "a.sqlite: the disk is full");
    EXPECT_EQ(queue.status().durable, 0u);
    EXPECT_EQ(queue.status().waiting, 2u);

    const auto newer = numberedChunk(3);
    queue.add({1, 0}, {newer, Provenance::Edited});
    EXPECT_FALSE(queue.flush());
    EXPECT_EQ(queue.find({1, 0})->chunk, newer);
    recorder.fail("");
    ASSERT_TRUE(queue.flush());
    EXPECT_EQ(queue.status().problem, "");
    EXPECT_EQ(queue.status().durable, 3u);
    ASSERT_EQ(recorder.batches.size(), 1u);
    EXPECT_EQ(recorder.batches[0].chunks.at({1, 0}).chunk, newer);
    EXPECT_EQ(recorder.batches[0].chunks.size(), 2u);
}

TEST(SaveQueue, WhatIsHeldTogetherIsOneBatch) {
    Recorder recorder;
    ManualClock clock;
    SaveQueue queue(recorder.write(), {.delay = 1s, .clock = &clock});
    queue.add({1, 2}, {numberedChunk(1), Provenance::Edited});
    {
        const auto held = queue.hold(), again = queue.hold();
        clock.now += 10s;
        clock.writeIfDue();
        EXPECT_TRUE(recorder.batches.empty()) << "no write begins meanwhile";
        queue.add("rules.isles", "score=i1;");
    }
    clock.writeIfDue();
    ASSERT_EQ(recorder.batches.size(), 1u);
    EXPECT_EQ(recorder.batches[0].chunks.size(), 1u);
    EXPECT_EQ(recorder.batches[0].metadata.size(), 1u);
}

TEST(SaveQueue, WithAManualClockItHasNoThread) {
    Recorder recorder;
    ManualClock clock;
    {
        SaveQueue queue(recorder.write(), {.delay = 100ms, .chunks = 2, .clock = &clock});
        queue.add({0, 0}, {numberedChunk(1), Provenance::Edited});
        clock.now += 99ms;
        clock.writeIfDue();
        EXPECT_EQ(queue.status().durable, 0u);
        clock.now += 1ms;
        recorder.fail("no");
        clock.writeIfDue();
        EXPECT_EQ(queue.status().problem, "no");
        recorder.fail("");
        clock.now += 100ms * kTryAgainDelays;
        clock.writeIfDue();
        EXPECT_EQ(queue.status().durable, 1u);
        for (int x = 0; x < 2; ++x) queue.add({x, 0}, {numberedChunk(1), Provenance::Edited});
        clock.writeIfDue();
        EXPECT_EQ(queue.status().durable, 3u) << "two chunks are due at once";
        queue.add({5, 0}, {numberedChunk(1), Provenance::Edited});
        EXPECT_TRUE(queue.flush());
        queue.add({6, 0}, {numberedChunk(1), Provenance::Edited});
    }
    EXPECT_EQ(recorder.batches.size(), 4u);
}

TEST(SaveQueue, TriedAgainByItself) {
    Recorder recorder;
    SaveQueue queue(recorder.write(), {.delay = 10ms, .chunks = 1});
    recorder.fail("no");
    queue.add({0, 0}, {numberedChunk(1), Provenance::Edited});
    ASSERT_TRUE(base::waitUntil([&] { return !queue.status().problem.empty(); }));
    recorder.fail("");
    ASSERT_TRUE(base::waitUntil([&] { return queue.status().durable >= 1; }));
    EXPECT_EQ(recorder.batches.size(), 1u);
}

std::string lastWords(const std::function<void(SaveQueue&)>& use) {
    Recorder recorder;
    recorder.fail("a.sqlite: the disk is full");
    testing::internal::CaptureStderr();
    {
        SaveQueue queue(recorder.write(), kNever);
        use(queue);
    }
    return testing::internal::GetCapturedStderr();
}

TEST(SaveQueue, WhatTheLastAttemptLosesIsNamed) {
    EXPECT_EQ(lastWords([](SaveQueue& queue) { queue.add("time", "0.5"); }),
              "terrane: error: a.sqlite: the disk is full; lost: 0 chunks, the setting time\n");
    EXPECT_EQ(lastWords([](SaveQueue& queue) {
                  queue.add({0, 0}, {numberedChunk(1), Provenance::Edited});
                  queue.add(DamagedRow{{1, 1}, 0, "cut off"});
              }),
              "terrane: error: a.sqlite: the disk is full; lost: 1 chunk, 1 damaged row in quarantine\n");
    EXPECT_EQ(lastWords([](SaveQueue& queue) {
                  queue.add("time", "0.5");
                  EXPECT_FALSE(queue.flush());
              }),
              "")
        << "who called flush() knows";
}

// A disk that is nearly full takes some batches and refuses others: the log tells of it once, and of its end
// once everything is written and nothing has failed for a while.
TEST(SaveQueue, AlternatingFailuresAreToldOnce) {
    int attempts = 0;
    bool isFull = true;
    ManualClock clock;
    testing::internal::CaptureStderr();
    {
        SaveQueue queue(
            [&](const SaveBatch&) -> base::Result<void> {
                if (++attempts % 2 == 1 && isFull) return base::fail("a.sqlite: the disk is full");
                return {};
            },
            {.delay = 1000ms, .clock = &clock});
        const auto play = [&](int seconds) {
            for (int k = 0; k < seconds; ++k) {
                queue.add({k, 0}, {numberedChunk(k), Provenance::Edited});
                clock.now += 1s;
                clock.writeIfDue();
            }
        };
        play(60);
        EXPECT_GT(attempts, 20);
        isFull = false;
        play(5);
        EXPECT_EQ(queue.status().problem, "");
        for (int k = 0; k < 20; ++k) {  // nothing more to write
            clock.now += 1s;
            clock.writeIfDue();
        }
        play(5);
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "terrane: error: a.sqlite: the disk is full; waiting, tried again every 2 s: 1 chunk\n"
              "terrane: saving works again\n");
}

TEST(SaveQueue, ManyThreads) {
    std::atomic<int> written = 0;
    {
        SaveQueue queue(
            [&](const SaveBatch& batch) -> base::Result<void> {
                written += static_cast<int>(batch.chunks.size());
                return {};
            },
            {.delay = 1ms, .chunks = 16});
        std::vector<std::thread> threads;
        for (int t = 0; t < 4; ++t) {
            threads.emplace_back([&queue, t] {
                for (int i = 0; i < 200; ++i) {
                    queue.add({i, t}, {numberedChunk(i), Provenance::Edited});
                    (void)queue.find({i, t});
                    if (i % 50 == 0 && !queue.flush()) ADD_FAILURE() << "nothing fails here";
                }
            });
        }
        for (std::thread& thread : threads) thread.join();
    }
    EXPECT_EQ(written, 800) << "each position was saved once";
}

}  // namespace
}  // namespace terrane::store
