#include "terrane/gen_gpu/pass_plan.h"

#include <algorithm>
#include <cassert>

#include "terrane/gen/generator.h"

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

PassCounts neededPasses(const gen::GeneratorGraph& generator, const std::vector<world::ChunkPos>& requested) {
    const int passCount = static_cast<int>(generator.passes.size());
    PassCounts counts;
    for (const world::ChunkPos pos : requested) counts[pos] = passCount;
    // A pass asks its neighbors only for lower ones: from the last pass down each count is final when it is
    // used.
    for (int pass = passCount; pass-- > 0;) {
        const int needed = gen::passesNeededAround(generator, pass);
        if (needed == 0) continue;
        std::vector<world::ChunkPos> running;
        for (const auto& [pos, count] : counts) {
            if (count > pass) running.push_back(pos);
        }
        for (const world::ChunkPos pos : running) {
            for (const world::ChunkPos around : gen::chunksAround(pos)) {
                counts[around] = std::max(counts[around], needed);
            }
        }
    }
    return counts;
}

}  // namespace terrane::gen_gpu
