// Limits the block entity data of a store's chunks in memory. Its compression ratio is unbounded, so a small
// file could exhaust memory; the sections of a chunk of 256 layers take 256 KiB at most. Data counts from
// reading a chunk until its last owner is gone; copies of chunks share it. Any thread may call the functions;
// the data may outlive the budget.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>

#include "terrane/base/result.h"
#include "terrane/store/chunks/bytes.h"
#include "terrane/world/chunk.h"

namespace terrane::store {

constexpr std::size_t kEntityBudgetBytes = std::size_t{1} << 30;

class EntityBudget {
  public:
    explicit EntityBudget(std::size_t maxBytes = kEntityBudgetBytes)
        : maxBytes_(maxBytes), used_(std::make_shared<std::atomic<std::size_t>>(0)) {}

    // Shares the data and charges it to the budget until its last owner is gone. Returns null if there is no
    // room.
    world::BlockEntityDataPtr hold(world::BlockEntityData data);
    bool hasRoomFor(std::size_t bytes) const { return bytes <= maxBytes_ && *used_ <= maxBytes_ - bytes; }
    // Returns true for the first call, so that one message is logged for all refused chunks.
    bool isFirstRefusal() { return !hasRefused_.exchange(true); }
    std::size_t usedBytes() const { return *used_; }
    std::size_t maxBytes() const { return maxBytes_; }

    // Locks the decompression of large chunks, up to 64 MiB each, against other threads.
    std::unique_lock<std::mutex> lockLargeChunks() { return std::unique_lock(largeChunks_); }

  private:
    std::size_t maxBytes_;
    std::shared_ptr<std::atomic<std::size_t>> used_;
    std::mutex largeChunks_;
    std::atomic<bool> hasRefused_ = false;
};

// Copies the bytes and charges them to the budget if there is one; returns OutOfResources if it has no room.
[[nodiscard]] base::Result<world::BlockEntityDataPtr> holdData(ByteView bytes, EntityBudget* budget);
[[nodiscard]] tl::unexpected<base::Error> overBudget(const EntityBudget& budget);

}  // namespace terrane::store
