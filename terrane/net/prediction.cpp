#include "terrane/net/prediction.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace terrane::net {

void Prediction::predict(std::uint32_t number, std::span<const world::PlacedBlock> before) {
    for (const auto& [pos, value] : before)
        ahead_.try_emplace(pos, Ahead{value, 0}).first->second.last = number;
}

std::vector<world::PlacedBlock> Prediction::takeIn(std::span<const world::PlacedBlock> blocks) {
    std::vector<world::PlacedBlock> shown;
    for (const world::PlacedBlock& block : blocks) {
        const auto found = ahead_.find(block.pos);
        if (found == ahead_.end())
            shown.push_back(block);
        else
            found->second.server = block.value;
    }
    return shown;
}

std::vector<world::PlacedBlock> Prediction::settle(std::uint32_t number) {
    std::vector<world::PlacedBlock> settled;
    std::erase_if(ahead_, [&](auto& entry) {
        if (entry.second.last > number) return false;
        settled.push_back({entry.first, std::move(entry.second.server)});
        return true;
    });
    std::ranges::sort(settled, {}, &world::PlacedBlock::pos);  // independent of the hash table's order
    return settled;
}

std::vector<world::PlacedBlock> Prediction::settleAll() {
    return settle(std::numeric_limits<std::uint32_t>::max());
}

}  // namespace terrane::net
