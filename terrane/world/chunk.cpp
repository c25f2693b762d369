#include "terrane/world/chunk.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace terrane::world {

void Chunk::setBlock(BlockIndex i, BlockId id) {
    setBlockState(i, 0);
    blocks_[i >> 12].set(i & 4095, id);
}

void Chunk::setBlockState(BlockIndex i, std::uint16_t value) {
    freeBlockEntityData(i);
    blockState_[i >> 12].set(i & 4095, value);
}

// A number in a block's block state is a slot only where that slot names the block as its owner.
const BlockEntityData* Chunk::blockEntityData(BlockIndex i) const {
    if (entitySlots_.empty()) return nullptr;
    const std::size_t slot = blockState(i);
    if (slot >= entitySlots_.size() || !entitySlots_[slot].used || entitySlots_[slot].owner != i)
        return nullptr;
    return entitySlots_[slot].data.get();
}

BlockEntityDataPtr Chunk::sharedBlockEntityData(BlockIndex i) const {
    return blockEntityData(i) ? entitySlots_[blockState(i)].data : nullptr;
}

void Chunk::setBlockEntityData(BlockIndex i, BlockEntityData data) {
    shareBlockEntityData(i, std::make_shared<const BlockEntityData>(std::move(data)));
}

void Chunk::shareBlockEntityData(BlockIndex i, BlockEntityDataPtr data) {
    assert(data && "clearBlockEntityData() takes data away");
    if (blockEntityData(i)) {
        entitySlots_[blockState(i)].data = std::move(data);
        return;
    }
    // Without holes nothing is searched: a chunk read from a save may have data in each of its blocks.
    auto slot = entitySlots_.end();
    if (usedSlots_ < entitySlots_.size()) {
        slot = std::find_if(entitySlots_.begin(), entitySlots_.end(),
                            [](const LargeSlot& s) { return !s.used; });
    } else {
        slot = entitySlots_.insert(slot, LargeSlot{});
    }
    ++usedSlots_;
    *slot = {.data = std::move(data), .owner = i, .used = true};

    const auto number = static_cast<std::size_t>(slot - entitySlots_.begin());
    assert(number < kBlocksPerChunk && "a chunk has one slot a block at most");
    blockState_[i >> 12].set(i & 4095, static_cast<std::uint16_t>(number));
}

void Chunk::clearBlockEntityData(BlockIndex i) {
    if (blockEntityData(i)) setBlockState(i, 0);
}

std::vector<BlockIndex> Chunk::blocksWithBlockEntityData() const {
    std::vector<BlockIndex> blocks;
    blocks.reserve(usedSlots_);
    for (const LargeSlot& slot : entitySlots_)
        if (slot.used) blocks.push_back(slot.owner);
    std::sort(blocks.begin(), blocks.end());
    return blocks;
}

void Chunk::setSection(int number, Section section) {
    assert(number >= 0 && number < kSectionsPerChunk && "number of a section in a chunk");
    freeBlockEntityDataOfSection(number);
    blocks_[static_cast<std::size_t>(number)] = std::move(section);
    blockState_[static_cast<std::size_t>(number)] = Section();
}

void Chunk::setBlockStateSection(int number, Section section) {
    assert(number >= 0 && number < kSectionsPerChunk && "number of a section in a chunk");
    freeBlockEntityDataOfSection(number);
    blockState_[static_cast<std::size_t>(number)] = std::move(section);
}

bool operator==(const Chunk& a, const Chunk& b) {
    const std::vector<BlockIndex> large = a.blocksWithBlockEntityData();
    if (a.blocks_ != b.blocks_ || large != b.blocksWithBlockEntityData()) return false;
    if (large.empty()) return a.blockState_ == b.blockState_;
    for (const BlockIndex i : large)
        if (*a.blockEntityData(i) != *b.blockEntityData(i)) return false;
    // Block state that leads to block entity data is a number of a slot.
    auto statesA = a.blockState_, statesB = b.blockState_;
    for (const BlockIndex i : large) {
        statesA[i >> 12].set(i & 4095, 0);
        statesB[i >> 12].set(i & 4095, 0);
    }
    return statesA == statesB;
}

std::size_t Chunk::memoryBytes() const {
    std::size_t bytes = sizeof(Chunk) - sizeof(blocks_) - sizeof(blockState_);
    for (const Section& section : blocks_) bytes += section.memoryBytes();
    for (const Section& section : blockState_) bytes += section.memoryBytes();
    bytes += entitySlots_.capacity() * sizeof(LargeSlot);
    for (const LargeSlot& slot : entitySlots_)
        if (slot.used) bytes += slot.data->capacity();
    return bytes;
}

void Chunk::freeBlockEntityData(BlockIndex i) {
    if (!blockEntityData(i)) return;
    entitySlots_[blockState(i)] = {};
    --usedSlots_;
    dropUnusedSlots();
}

void Chunk::freeBlockEntityDataOfSection(int number) {
    for (LargeSlot& slot : entitySlots_) {
        if (!slot.used || slot.owner >> 12 != number) continue;
        slot = {};
        --usedSlots_;
    }
    dropUnusedSlots();
}

void Chunk::dropUnusedSlots() {
    while (!entitySlots_.empty() && !entitySlots_.back().used) entitySlots_.pop_back();
}

}  // namespace terrane::world
