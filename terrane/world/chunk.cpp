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
    // Without holes nothing is searched: a chunk read from a save may have data in each of its blocks.
    auto slot = large_.end();
    if (usedSlots_ < large_.size()) {
        slot = std::find_if(large_.begin(), large_.end(), [](const LargeSlot& s) { return !s.used; });
    } else {
        slot = large_.insert(slot, LargeSlot{});
    }
    ++usedSlots_;
    *slot = {.data = std::move(data), .owner = i, .used = true};

    const auto number = static_cast<std::size_t>(slot - large_.begin());
    assert(number < kBlocksPerChunk && "a chunk has one slot a block at most");
    smallData_[i >> 12].set(i & 4095, static_cast<std::uint16_t>(number));
}

void Chunk::clearLargeData(BlockIndex i) {
    if (largeData(i)) setSmallData(i, 0);
}

std::vector<BlockIndex> Chunk::blocksWithLargeData() const {
    std::vector<BlockIndex> blocks;
    blocks.reserve(usedSlots_);
    for (const LargeSlot& slot : large_)
        if (slot.used) blocks.push_back(slot.owner);
    std::sort(blocks.begin(), blocks.end());
    return blocks;
}

void Chunk::setSection(int number, Section section) {
    assert(number >= 0 && number < kSectionsPerChunk && "number of a section in a chunk");
    freeLargeDataOfSection(number);
    blocks_[static_cast<std::size_t>(number)] = std::move(section);
    smallData_[static_cast<std::size_t>(number)] = Section();
}

void Chunk::setSmallDataSection(int number, Section section) {
    assert(number >= 0 && number < kSectionsPerChunk && "number of a section in a chunk");
    freeLargeDataOfSection(number);
    smallData_[static_cast<std::size_t>(number)] = std::move(section);
}

bool operator==(const Chunk& a, const Chunk& b) {
    const std::vector<BlockIndex> large = a.blocksWithLargeData();
    if (a.blocks_ != b.blocks_ || large != b.blocksWithLargeData()) return false;
    if (large.empty()) return a.smallData_ == b.smallData_;
    for (const BlockIndex i : large)
        if (*a.largeData(i) != *b.largeData(i)) return false;
    // Small data that leads to large data is a number of a slot.
    auto smallA = a.smallData_, smallB = b.smallData_;
    for (const BlockIndex i : large) {
        smallA[i >> 12].set(i & 4095, 0);
        smallB[i >> 12].set(i & 4095, 0);
    }
    return smallA == smallB;
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
    --usedSlots_;
    dropUnusedSlots();
}

void Chunk::freeLargeDataOfSection(int number) {
    for (LargeSlot& slot : large_) {
        if (!slot.used || slot.owner >> 12 != number) continue;
        slot = {};
        --usedSlots_;
    }
    dropUnusedSlots();
}

void Chunk::dropUnusedSlots() {
    while (!large_.empty() && !large_.back().used) large_.pop_back();
}

}  // namespace terrane::world
