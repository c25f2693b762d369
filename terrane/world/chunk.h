// A chunk: 16×16×256 blocks with their small and large data. A plain value; copying it copies a few
// kilobytes.
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

// Bytes that a block keeps beyond its 16 bits of small data, for example the text of a sign.
using LargeData = std::vector<std::byte>;

// Block access is O(1). Not synchronised; the world shares chunks between threads as `shared_ptr<const
// Chunk>`.
class Chunk {
  public:
    BlockId block(BlockIndex i) const { return blocks_[i >> 12].get(i & 4095); }
    // Sets the block and resets its small data to 0; large data it had is freed.
    void setBlock(BlockIndex i, BlockId id);

    std::uint16_t smallData(BlockIndex i) const { return smallData_[i >> 12].get(i & 4095); }
    // Large data the block had is freed: its small data was the way to it.
    void setSmallData(BlockIndex i, std::uint16_t value);

    // Large data of a block: its small data holds the index of a slot, which set and clear look after.
    const LargeData* largeData(BlockIndex i) const;  // null where the block has none
    void setLargeData(BlockIndex i, LargeData data);
    void clearLargeData(BlockIndex i);
    std::vector<BlockIndex> blocksWithLargeData() const;  // in ascending order

    const Section& section(int number) const { return blocks_[static_cast<std::size_t>(number)]; }
    const Section& smallDataSection(int number) const { return smallData_[static_cast<std::size_t>(number)]; }
    // Replaces a whole section's blocks; its small data becomes 0.
    void setSection(int number, Section section);
    // Replaces a whole section's small data; large data of its blocks is freed.
    void setSmallDataSection(int number, Section section);

    std::size_t memoryBytes() const;  // heap and object

    // Equal blocks with equal data. In which slots large data lies makes no difference.
    friend bool operator==(const Chunk& a, const Chunk& b);

  private:
    std::array<Section, kSectionsPerChunk> blocks_;
    std::array<Section, kSectionsPerChunk> smallData_;
    // Slot k holds the large data of the block `owner`, whose small data is k.
    struct LargeSlot {
        LargeData data;
        BlockIndex owner = 0;
        bool used = false;
    };
    void freeLargeData(BlockIndex i);  // leaves the small data that led to it
    void freeLargeDataOfSection(int number);
    void dropUnusedSlots();  // those at the end

    std::vector<LargeSlot> large_;
    std::size_t usedSlots_ = 0;
};

using ChunkPtr = std::shared_ptr<const Chunk>;

}  // namespace terrane::world
