// Conflict detection: decides which edits of a server are accepted, from the events that it had received
// before. A plain class, for the thread that writes the history.
//
// Events that a server receives (edits of others, refusals of its own) are numbered in this order. The basis
// of an own edit is the number of the last event received before it. The edit is refused if an event after
// its basis changed one of its blocks.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/net/edit_log.h"

namespace terrane::net_postgres {

class HistoryOrder {
  public:
    // Adds the next event, which changes these blocks. Returns its number.
    std::uint64_t hear(std::span<const world::BlockPos> blocks);
    std::uint64_t heard() const { return heard_; }

    bool isAccepted(std::span<const world::BlockPos> blocks, std::uint64_t basis) const;

    // Drops events up to `basis`: no edit with a lower basis will follow.
    void forget(std::uint64_t basis);
    std::size_t size() const { return changedBy_.size(); }

  private:
    std::uint64_t heard_ = 0;
    // Number of the last event that changed each block.
    std::unordered_map<world::BlockPos, std::uint64_t, world::BlockPosHash> changedBy_;
};

std::vector<world::BlockPos> blocksOf(const net::LoggedEdit& edit);

}  // namespace terrane::net_postgres
