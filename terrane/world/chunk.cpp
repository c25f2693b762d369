#include "terrane/world/chunk.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace terrane::world {

void Chunk::setBlock(BlockIndex i, BlockId id) {
    setSmallData(i, 0);
    blocks_[i >> 12].set(i & 4095, id);
}

void Chunk::setSmallData(BlockIndex i, std::uint16_t value) {
    freeLargeData(i);
    smallData_[i >> 12].set(i & 4095, value);
}

// A number in a block's small data is a slot only where that slot names the block as its owner.
const LargeData* Chunk::largeData(BlockIndex i) const {
    if (large_.empty()) return nullptr;
    const std::size_t slot = smallData(i);
    if (slot >= large_.size() || !large_[slot].used || large_[slot].owner != i) return nullptr;
    return &large_[slot].data;
}

void Chunk::setLargeData(BlockIndex i, LargeData data) {
    if (largeData(i)) {
        large_[smallData(i)].data = std::move(data);
        return;
    }
    auto slot = std::find_if(large_.begin(), large_.end(), [](const LargeSlot& s) { return !s.used; });
    if (slot == large_.end()) slot = large_.insert(slot, LargeSlot{});
    *slot = {.data = std::move(data), .owner = i, .used = true};

    const auto number = static_cast<std::size_t>(slot - large_.begin());
    assert(number < kBlocksPerChunk && "a chunk has one slot a block at most");
    smallData_[i >> 12].set(i & 4095, static_cast<std::uint16_t>(number));
}

void Chunk::clearLargeData(BlockIndex i) {
    if (largeData(i)) setSmallData(i, 0);
}

void Chunk::setSection(int number, Section section) {
    assert(number >= 0 && number < kSectionsPerChunk && "number of a section in a chunk");
    for (LargeSlot& slot : large_)
        if (slot.used && slot.owner >> 12 == number) slot = {};
    dropUnusedSlots();
    blocks_[static_cast<std::size_t>(number)] = std::move(section);
    smallData_[static_cast<std::size_t>(number)] = Section();
}

std::size_t Chunk::memoryBytes() const {
    std::size_t bytes = sizeof(Chunk) - sizeof(blocks_) - sizeof(smallData_);
    for (const Section& section : blocks_) bytes += section.memoryBytes();
    for (const Section& section : smallData_) bytes += section.memoryBytes();
    bytes += large_.capacity() * sizeof(LargeSlot);
    for (const LargeSlot& slot : large_) bytes += slot.data.capacity();
    return bytes;
}

void Chunk::freeLargeData(BlockIndex i) {
    if (!largeData(i)) return;
    large_[smallData(i)] = {};
    dropUnusedSlots();
}

void Chunk::dropUnusedSlots() {
    while (!large_.empty() && !large_.back().used) large_.pop_back();
}

}  // namespace terrane::world
