#include "terrane/gen_gpu/slot_cache.h"

#include <cassert>

namespace terrane::gen_gpu {

SlotCache::SlotCache(std::size_t slots) {
    for (std::size_t s = slots; s-- > 0;) free_.push_back(static_cast<std::uint32_t>(s));
}

void SlotCache::reserve(const std::vector<world::ChunkPos>& chunks) {
    assert(chunks.size() <= entries_.size() + free_.size() && "all chunks have a slot at once");
    // Moves chunks that have a slot to the front first, so that none of them is replaced below.
    for (const world::ChunkPos pos : chunks) {
        const auto it = entries_.find(pos);
        if (it != entries_.end()) order_.splice(order_.begin(), order_, it->second.order);
    }
    for (const world::ChunkPos pos : chunks) {
        if (entries_.contains(pos)) continue;
        if (free_.empty()) {
            const auto oldest = entries_.find(order_.back());
            free_.push_back(oldest->second.slot);
            entries_.erase(oldest);
            order_.pop_back();
        }
        order_.push_front(pos);
        entries_.emplace(pos, Entry{free_.back(), 0, order_.begin()});
        free_.pop_back();
    }
}

std::optional<std::uint32_t> SlotCache::find(world::ChunkPos pos) const {
    const auto it = entries_.find(pos);
    return it == entries_.end() ? std::nullopt : std::optional(it->second.slot);
}

}  // namespace terrane::gen_gpu
