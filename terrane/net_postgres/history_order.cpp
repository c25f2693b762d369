#include "terrane/net_postgres/history_order.h"

#include <algorithm>

namespace terrane::net_postgres {

std::uint64_t HistoryOrder::hear(std::span<const world::BlockPos> blocks) {
    ++heard_;
    for (const world::BlockPos pos : blocks) changedBy_[pos] = heard_;
    return heard_;
}

bool HistoryOrder::isAccepted(std::span<const world::BlockPos> blocks, std::uint64_t basis) const {
    return std::ranges::none_of(blocks, [&](world::BlockPos pos) {
        const auto found = changedBy_.find(pos);
        return found != changedBy_.end() && found->second > basis;
    });
}

void HistoryOrder::forget(std::uint64_t basis) {
    std::erase_if(changedBy_, [&](const auto& entry) { return entry.second <= basis; });
}

std::vector<world::BlockPos> blocksOf(const net::LoggedEdit& edit) {
    std::vector<world::BlockPos> blocks;
    blocks.reserve(edit.after.size());
    for (const net::ChangedBlock& block : edit.after)
        blocks.push_back(world::blockPos(edit.chunk, block.index));
    return blocks;
}

}  // namespace terrane::net_postgres
