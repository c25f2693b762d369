// The results of the pipeline's jobs for its thread, and the time that they took.
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
#include "terrane/stream/depth.h"
#include "terrane/stream/meshing.h"

namespace terrane::stream {

enum Task : std::size_t { kLoad, kGenerate, kDeepen, kLocalLight, kLight, kMesh, kTaskCount };

// Any thread adds results. Jobs share the object, since they may end after the pipeline.
struct WorkerResults {
    struct Load {
        world::ChunkPos pos;
        ReadChunk read;  // null: to be made by a batch generator
        LocalLightPtr localLight;
    };
    struct Deepened {
        DepthJob job;
        world::ChunkPtr former;
        ReadChunk deeper;
        LocalLightPtr localLight;  // of `deeper`
    };
    struct Lit {
        world::ChunkPos pos;
        light::ChunkLightPtr light;
        MeshPtr mesh;  // null if the caller of the pipeline makes meshes
    };
    struct Meshed {
        MeshJob job;
        MeshPtr mesh;
    };
    struct Lists {
        std::vector<Load> loads;
        std::vector<Deepened> deepened;
        std::vector<Lit> lit;
        std::vector<Meshed> meshed;
        std::exception_ptr failure;  // the first

        bool isEmpty() const {
            return loads.empty() && deepened.empty() && lit.empty() && meshed.empty() && !failure;
        }
        void add(Load load) { loads.push_back(std::move(load)); }
        void add(Deepened chunk) { deepened.push_back(std::move(chunk)); }
        void add(Lit chunk) { lit.push_back(std::move(chunk)); }
        void add(Meshed chunk) { meshed.push_back(std::move(chunk)); }
    };

    std::mutex mutex;
    std::condition_variable changed;
    Lists lists;                      // under the mutex
    std::atomic<bool> isOver{false};  // no results are taken any more: jobs that begin now do nothing

    // Runs work that returns a pointer, and counts it unless the pointer is null. Any thread may call it,
    // without the mutex.
    template <class Work>
    auto timed(std::size_t task, Work work) {
        const auto start = std::chrono::steady_clock::now();
        auto result = work();
        if (!result) return result;
        const auto time = std::chrono::steady_clock::now() - start;
        nanoseconds[task] += std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
        ++counts[task];
        return result;
    }
    std::array<std::atomic<std::int64_t>, kTaskCount> nanoseconds{};
    std::array<std::atomic<std::size_t>, kTaskCount> counts{};

    template <class Result>
    void add(Result result) {
        const std::lock_guard lock(mutex);
        lists.add(std::move(result));
        changed.notify_one();
    }
    void fail(std::exception_ptr error) {
        const std::lock_guard lock(mutex);
        if (!lists.failure) lists.failure = std::move(error);
        changed.notify_one();
    }
    Lists takeAll() {
        const std::lock_guard lock(mutex);
        return std::exchange(lists, {});
    }
    void waitForAny(std::chrono::milliseconds timeout) {
        std::unique_lock lock(mutex);
        changed.wait_for(lock, timeout, [&] { return !lists.isEmpty(); });
    }
};

}  // namespace terrane::stream
