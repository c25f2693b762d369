#include "terrane/gen/pass_cache.h"

namespace terrane::gen {

std::shared_ptr<ChunkWork> PassCache::get(world::ChunkPos pos) {
    const std::lock_guard lock(mutex_);
    if (const auto it = entries_.find(pos); it != entries_.end()) {
        order_.splice(order_.begin(), order_, it->second.order);
        return it->second.work;
    }
    auto work = std::make_shared<ChunkWork>(fieldCount_, passCount_);
    Order newest = {pos};
    entries_.emplace(pos, Entry{work, newest.begin()});
    order_.splice(order_.begin(), newest);  // last, as it cannot throw: both containers have the same chunks
    if (entries_.size() > capacity_) {
        entries_.erase(order_.back());
        order_.pop_back();
    }
    return work;
}

}  // namespace terrane::gen
