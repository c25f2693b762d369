// What the pipeline's jobs leave for its thread, and how long they took.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

#include "terrane/stream/chunk_jobs.h"
#include "terrane/world/coords.h"

namespace terrane::stream {

enum Task : std::size_t { kLoad, kOwnLight, kLight, kMesh, kTaskCount };

// Filled by any thread. Jobs hold it too, so that one that ends late finds it alive.
struct WorkerResults {
    struct Load {
        world::ChunkPos pos;
        world::ChunkPtr chunk;  // null: to be made by a batch generator
        LocalLightPtr local;
    };
    struct Finish {
        world::ChunkPos pos;
        MeshPtr mesh;
        light::ChunkLightPtr light;
    };
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<Load> loads;
    std::vector<Finish> finishes;
    std::exception_ptr failure;       // the first
    std::atomic<bool> isOver{false};  // nobody takes results any more: jobs that begin now do nothing

    // Runs work and counts it. Any thread, without the mutex.
    template <class Work>
    auto timed(std::size_t task, Work work) {
        const auto start = std::chrono::steady_clock::now();
        auto result = work();
        const auto time = std::chrono::steady_clock::now() - start;
        nanoseconds[task] += std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
        ++counts[task];
        return result;
    }
    std::array<std::atomic<std::int64_t>, kTaskCount> nanoseconds{};
    std::array<std::atomic<std::size_t>, kTaskCount> counts{};

    void add(Load load) {
        const std::lock_guard lock(mutex);
        loads.push_back(std::move(load));
        changed.notify_one();
    }
    void add(Finish finish) {
        const std::lock_guard lock(mutex);
        finishes.push_back(std::move(finish));
        changed.notify_one();
    }
    void fail(std::exception_ptr error) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::move(error);
        changed.notify_one();
    }
    bool isEmpty() const { return loads.empty() && finishes.empty() && !failure; }
};

}  // namespace terrane::stream
