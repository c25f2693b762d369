// A chunk: 16×16×256 blocks with their block states and block entity data. A plain value; copying it copies a
// few kilobytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "terrane/world/coords.h"
#include "terrane/world/section.h"

namespace terrane::world {

using BlockId = std::uint16_t;
constexpr BlockId kAir = 0;

// Bytes that a block keeps beyond its 16 bits of block state, for example the text of a sign.
using BlockEntityData = std::vector<std::byte>;
using BlockEntityDataPtr = std::shared_ptr<const BlockEntityData>;

// Block access is O(1). Not synchronised; the world shares chunks between threads as `shared_ptr<const
// Chunk>`.
class Chunk {
  public:
    BlockId block(BlockIndex i) const { return blocks_[i >> 12].get(i & 4095); }
    // Sets the block and resets its block state to 0; block entity data it had is freed.
    void setBlock(BlockIndex i, BlockId id);

    std::uint16_t blockState(BlockIndex i) const { return blockState_[i >> 12].get(i & 4095); }
    // Block entity data the block had is freed: its block state was the way to it.
    void setBlockState(BlockIndex i, std::uint16_t value);

    // Block entity data of a block: its block state holds the index of a slot, which set and clear look
    // after.
    const BlockEntityData* blockEntityData(BlockIndex i) const;  // null where the block has none
    BlockEntityDataPtr sharedBlockEntityData(BlockIndex i) const;
    void setBlockEntityData(BlockIndex i, BlockEntityData data);
    void shareBlockEntityData(BlockIndex i,
                              BlockEntityDataPtr data);  // not null; copies of the chunk share it
    void clearBlockEntityData(BlockIndex i);
    std::vector<BlockIndex> blocksWithBlockEntityData() const;  // in ascending order

    const Section& section(int number) const { return blocks_[static_cast<std::size_t>(number)]; }
    const Section& blockStates(int number) const { return blockState_[static_cast<std::size_t>(number)]; }
    // Replaces a whole section's blocks; its block state becomes 0.
    void setSection(int number, Section section);
    // Replaces a whole section's block state; block entity data of its blocks is freed.
    void setBlockStateSection(int number, Section section);
    // Brings it to its smallest form; its values stay.
    void compactBlockState(int number) { blockState_[static_cast<std::size_t>(number)].compact(); }

    std::size_t memoryBytes() const;  // heap and object

    // Equal blocks with equal data. In which slots block entity data lies makes no difference.
    friend bool operator==(const Chunk& a, const Chunk& b);

  private:
    std::array<Section, kSectionsPerChunk> blocks_;
    std::array<Section, kSectionsPerChunk> blockState_;
    // Slot k holds the block entity data of the block `owner`, whose block state is k.
    struct LargeSlot {
        BlockEntityDataPtr data;
        BlockIndex owner = 0;
        bool used = false;
    };
    void freeBlockEntityData(BlockIndex i);  // leaves the block state that led to it
    void freeBlockEntityDataOfSection(int number);
    void dropUnusedSlots();  // those at the end

    std::vector<LargeSlot> entitySlots_;
    std::size_t usedSlots_ = 0;
};

using ChunkPtr = std::shared_ptr<const Chunk>;

}  // namespace terrane::world
