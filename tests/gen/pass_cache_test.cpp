#include "terrane/gen/generator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "tests/gen/gen_fixture.h"

namespace terrane::gen {
namespace {

TEST(PassCache, AWorkHasRoomForEveryFieldAndPass) {
    PassCache cache(chunks(4), 3, 5);
    const auto work = cache.get({7, -7});
    EXPECT_EQ(work->fields.size(), 3u);
    EXPECT_EQ(work->blocks.size(), 5u);
    for (const auto& blocks : work->blocks) EXPECT_EQ(blocks, nullptr);
    EXPECT_EQ(work->passesDone(), 0);
}

TEST(PassCache, TheSameChunkIsTheSameWork) {
    PassCache cache(chunks(4), 1, 1);
    const auto a = cache.get({1, 2}), b = cache.get({2, 1});
    EXPECT_NE(a, b);
    EXPECT_EQ(cache.get({1, 2}), a);
    EXPECT_EQ(cache.get({2, 1}), b);
}

TEST(PassCache, LevelsAreChunksOfTheirOwn) {
    PassCache cache(chunks(4), 1, 1);
    const auto fine = cache.get({1, 2, 0}), coarse = cache.get({1, 2, 3});
    EXPECT_NE(fine, coarse);
    EXPECT_EQ(cache.get({1, 2, 3}), coarse);
}

TEST(PassCache, TheChunkUsedLongestAgoGoesFirst) {
    PassCache cache(chunks(2), 1, 1);
    const std::weak_ptr<ChunkWork> a = cache.get({0, 0}), b = cache.get({1, 0});
    cache.get({0, 0});  // used again: now b is the older one
    cache.get({2, 0});
    EXPECT_FALSE(a.expired());
    EXPECT_TRUE(b.expired());
}

TEST(PassCache, AWorkThatSomebodyHoldsStaysAlive) {
    PassCache cache(chunks(1), 1, 1);
    const auto held = cache.get({0, 0});
    held->advance(1, [](int) {});
    cache.get({1, 0});
    EXPECT_EQ(held->passesDone(), 1);
    const auto again = cache.get({0, 0});
    EXPECT_NE(again, held) << "the cache had let go of it";
    EXPECT_EQ(again->passesDone(), 0);
}

TEST(PassCache, ACapacityOfNoneStillWorks) {
    PassCache cache(chunks(0), 1, 1);
    const auto a = cache.get({0, 0});
    ASSERT_NE(a, nullptr);
    EXPECT_NE(cache.get({0, 0}), a);
}

TEST(PassCache, KeepsAsManyAsItsCapacity) {
    PassCache cache(chunks(50), 1, 1);
    std::vector<std::weak_ptr<ChunkWork>> works;
    for (std::int32_t k = 0; k < 200; ++k) works.push_back(cache.get({k, -k}));
    for (std::size_t k = 0; k < works.size(); ++k) EXPECT_EQ(works[k].expired(), k < 150) << k;
}

// Blocks count once they are there; the fewest chunks stay as long as they do not need far too much.
TEST(PassCache, ForgetsByMemory) {
    const std::size_t each = ChunkWork::memoryBytes(1, 1), room = 10 * each;
    PassCache cache({.bytes = room, .minChunks = 3}, 1, 1);
    std::vector<std::weak_ptr<ChunkWork>> works;
    const auto count = [&] {
        return std::count_if(works.begin(), works.end(), [](const auto& work) { return !work.expired(); });
    };
    for (std::int32_t k = 0; k < 20; ++k) works.push_back(cache.get({k, 0}));
    EXPECT_EQ(count(), 10);
    EXPECT_EQ(cache.bytes(), room);
    const auto grow = [&](std::int32_t k, std::size_t bytes) {
        cache.addBytes({k, 0}, *cache.get({k, 0}), bytes);
    };
    grow(19, room / 2);
    EXPECT_EQ(count(), 5);
    EXPECT_EQ(cache.bytes(), room);
    grow(18, 2 * room);
    EXPECT_EQ(count(), 3);
    EXPECT_GT(cache.bytes(), room);
    grow(18, CacheSize::kMostTimes * room);
    EXPECT_LT(count(), 3);
    EXPECT_LE(cache.bytes(), room);
}

TEST(ChunkWork, EachPassRunsOnceAndInOrder) {
    ChunkWork work(1, 3);
    std::vector<int> passes;  // never two at a time, which TSan checks
    const auto advance = [&](int count) { work.advance(count, [&](int pass) { passes.push_back(pass); }); };
    std::vector<std::thread> threads;
    for (int t = 0; t < 6; ++t) threads.emplace_back([&, t] { advance(1 + t % 3); });
    for (std::thread& t : threads) t.join();
    EXPECT_EQ(passes, (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(work.passesDone(), 3);
}

// As when memory runs out: a thread that waits for the pass runs it.
TEST(ChunkWork, APassThatThrowsIsAnybodysAgain) {
    ChunkWork work(1, 1);
    std::atomic<bool> isRunning = false, mayThrow = false;
    std::thread failing([&] {
        EXPECT_THROW(work.advance(1,
                                  [&](int) {
                                      isRunning = true;
                                      mayThrow.wait(false);
                                      throw std::bad_alloc();
                                  }),
                     std::bad_alloc);
    });
    while (!isRunning) std::this_thread::yield();
    std::atomic<int> runs = 0;
    std::vector<std::thread> waiting;
    for (int t = 0; t < 3; ++t) waiting.emplace_back([&] { work.advance(1, [&](int) { ++runs; }); });
    mayThrow = true;
    mayThrow.notify_all();
    failing.join();
    for (std::thread& t : waiting) t.join();
    EXPECT_EQ(runs, 1);
    EXPECT_EQ(work.passesDone(), 1);
}

// One work a chunk, however many ask at once; nothing is lost while others push it out.
TEST(PassCache, ManyThreadsAsk) {
    PassCache large(chunks(100), 1, 1), small(chunks(3), 1, 1);
    std::array<std::atomic<ChunkWork*>, 64> first{};
    std::atomic<int> differing = 0;
    const auto ask = [&](int thread) {
        for (int k = 0; k < 2000; ++k) {
            const int number = (k * 7 + thread * 13) % 64;
            const ChunkPos pos = {number % 8, number / 8};
            const auto work = large.get(pos);
            ChunkWork* expected = nullptr;
            auto& slot = first[static_cast<std::size_t>(number)];
            if (!slot.compare_exchange_strong(expected, work.get()) && expected != work.get()) ++differing;
            small.get(pos)->advance(1, [](int) {});
        }
    };
    std::vector<std::thread> threads;
    for (int t = 0; t < 6; ++t) threads.emplace_back(ask, t);
    for (std::thread& t : threads) t.join();
    EXPECT_EQ(differing, 0);
}

}  // namespace
}  // namespace terrane::gen
