#include "terrane/render/quads/mesh_section_order.h"

#include <algorithm>
#include <cassert>

namespace terrane::render {
namespace {

// Distance along one axis from a chunk of level 0 to the nearest chunk of level 0 that a chunk of the level
// covers.
std::int64_t chunksBetween(std::int32_t from, std::int32_t to, std::uint8_t level) {
    const std::int64_t first = std::int64_t{to} << level, last = first + world::columnWidth(level) - 1;
    return std::clamp<std::int64_t>(from, first, last) - from;
}

}  // namespace

void MeshSectionOrder::add(std::uint32_t slot, world::ChunkPos pos, std::int32_t heights) {
    if (slot >= numbers_.size()) numbers_.resize(slot + 1);
    assert(numbers_[slot] == 0 && "a slot has one mesh section");
    numbers_[slot] = ++lastNumber_;
    added_.push_back({0, pos.x, pos.y, pos.level, heights, slot, lastNumber_});
}

// The entry stays until the next update.
void MeshSectionOrder::remove(std::uint32_t slot) {
    assert(numbers_[slot] != 0 && "the slot has a mesh section");
    numbers_[slot] = 0;
    hasGone_ = true;
}

void MeshSectionOrder::measure(std::vector<Entry>& entries) const {
    for (Entry& entry : entries) {
        const std::int64_t x = chunksBetween(center_.x, entry.x, entry.level);
        const std::int64_t y = chunksBetween(center_.y, entry.y, entry.level);
        entry.distance = static_cast<std::uint32_t>(std::min<std::int64_t>(x * x + y * y, UINT32_MAX));
    }
}

// While chunks stream in, a frame changes few of thousands of mesh sections: these are sorted and merged in.
// All are sorted when the camera has entered another chunk.
bool MeshSectionOrder::update(world::ChunkPos center) {
    const bool hasMoved = center != center_;
    if (!hasMoved && !hasGone_ && added_.empty()) return false;
    center_ = center;
    if (hasGone_) {
        const auto isGone = [this](const Entry& entry) { return this->isGone(entry); };
        std::erase_if(sorted_, isGone);
        std::erase_if(added_, isGone);
        hasGone_ = false;
    }
    measure(added_);
    std::ranges::sort(added_);
    const auto added = sorted_.insert(sorted_.end(), added_.begin(), added_.end());
    if (hasMoved) {
        measure(sorted_);
        std::ranges::sort(sorted_);
    } else {
        std::ranges::inplace_merge(sorted_, added);
    }
    added_.clear();
    slots_.resize(sorted_.size());
    std::ranges::transform(sorted_, slots_.begin(), &Entry::slot);
    return true;
}

}  // namespace terrane::render
