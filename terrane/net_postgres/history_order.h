// Who was first: decides which edits of one server are accepted, by what it knew when it made them. A plain
// class, for the thread that writes the history.
//
// What a server hears (edits of others, refusals of its own) has numbers in the order in which it hears it.
// An own edit was made after the server had heard up to some number, its basis. It is refused where one of
// its blocks became another one by something that it had not heard.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/net/edit_log.h"

namespace terrane::net_postgres {

class HistoryOrder {
  public:
    // The next thing that the server hears: it changes these blocks. Gives its number.
    std::uint64_t hear(std::span<const world::BlockPos> blocks);
    std::uint64_t heard() const { return heard_; }

    bool isAccepted(std::span<const world::BlockPos> blocks, std::uint64_t basis) const;

    // No edit with a lower basis will come.
    void forget(std::uint64_t basis);
    std::size_t size() const { return changedBy_.size(); }

  private:
    std::uint64_t heard_ = 0;
    std::unordered_map<world::BlockPos, std::uint64_t, world::BlockPosHash> changedBy_;  // the last one
};

std::vector<world::BlockPos> blocksOf(const net::LoggedEdit& edit);

}  // namespace terrane::net_postgres
