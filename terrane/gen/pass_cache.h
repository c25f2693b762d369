// Intermediate results of chunks, shared by the threads that generate. Keeps the most recently used ones.
#pragma once

#include <atomic>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "terrane/gen/executor.h"

namespace terrane::gen {

// One chunk on its way through the passes. Results of the first `passesDone` passes never change again.
struct ChunkWork {
    ChunkWork(std::size_t fieldCount, std::size_t passCount) : fields(fieldCount), blocks(passCount) {}

    // Completes the first `passes` passes: calls run(pass) for each pass that no thread runs, and waits for a
    // pass that another thread runs. Rethrows an exception of `run`; then any thread may run the pass.
    template <class Run>
    void advance(int passes, const Run& run);

    int passesDone() const { return state_.load(std::memory_order_acquire) / 2; }

    std::vector<ColumnValues> fields;                 // by field
    std::vector<std::unique_ptr<BlockArray>> blocks;  // by pass; null for 2D passes

  private:
    void setState(int state) {
        state_.store(state, std::memory_order_release);
        state_.notify_all();
    }

    std::atomic<int> state_ = 0;  // 2 × passes done, + 1 while a thread runs the next one
};

template <class Run>
void ChunkWork::advance(int passes, const Run& run) {
    for (;;) {
        int state = state_.load(std::memory_order_acquire);
        if (state / 2 >= passes) return;
        if (state % 2 != 0) {
            state_.wait(state, std::memory_order_acquire);
            continue;
        }
        if (!state_.compare_exchange_strong(state, state + 1)) continue;
        try {
            run(state / 2);
        } catch (...) {
            setState(state);  // wakes the threads that wait for this pass
            throw;
        }
        setState(state + 2);
    }
}

class PassCache {
  public:
    PassCache(std::size_t capacity, std::size_t fieldCount, std::size_t passCount)
        : capacity_(capacity), fieldCount_(fieldCount), passCount_(passCount) {}

    // The chunk's work, new if it is not kept. A work stays alive while a caller holds it.
    std::shared_ptr<ChunkWork> get(world::ChunkPos pos);

    std::size_t size() {
        const std::lock_guard lock(mutex_);
        return entries_.size();
    }

  private:
    using Order = std::list<world::ChunkPos>;
    struct Entry {
        std::shared_ptr<ChunkWork> work;
        Order::iterator order;
    };

    std::mutex mutex_;
    std::size_t capacity_, fieldCount_, passCount_;
    Order order_;  // most recently used first
    std::unordered_map<world::ChunkPos, Entry, world::ChunkPosHash> entries_;
};

}  // namespace terrane::gen
