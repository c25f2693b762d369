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

// One chunk on its way through the passes. Pass k is run by the thread that raises `claimed` from k to k + 1;
// who needs its result waits on `passesDone`. Results of the first `passesDone` passes never change again.
struct ChunkWork {
    ChunkWork(std::size_t fieldCount, std::size_t passCount) : fields(fieldCount), blocks(passCount) {}

    std::atomic<int> claimed = 0, passesDone = 0;
    std::vector<ColumnValues> fields;                 // by field
    std::vector<std::unique_ptr<BlockArray>> blocks;  // by pass; null for 2D passes
};

class PassCache {
  public:
    PassCache(std::size_t capacity, std::size_t fieldCount, std::size_t passCount)
        : capacity_(capacity), fieldCount_(fieldCount), passCount_(passCount) {}

    // The chunk's work, new where it is not kept. A work stays alive while somebody holds it.
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
