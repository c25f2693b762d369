// A chunk: a column of 16×16 blocks from the world's bottom to its top, with their block states and block
// entity data. A plain value; copies share the memory of their sections until one of them changes.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "terrane/base/digest.h"
#include "terrane/world/coords.h"
#include "terrane/world/section.h"

namespace terrane::world {

using BlockId = std::uint16_t;
constexpr BlockId kAir = 0;
// The block of sections that are not made yet: no registry has it, so it counts as "missing", which is closed
// and dark.
constexpr BlockId kUnmade = UINT16_MAX;

// The bytes of a block beyond its 16 bits of block state, for example the text of a sign.
using BlockEntityData = std::vector<std::byte>;
using BlockEntityDataPtr = std::shared_ptr<const BlockEntityData>;

// Block access is O(1). It is not synchronised; the world shares chunks between threads as `shared_ptr<const
// Chunk>`.
//
// Blocks and sections are in the chunk's heights; section numbers are those of heights.h.
class Chunk {
  public:
    // Filled with air.
    Chunk() : Chunk(Heights()) {}
    explicit Chunk(Heights heights);

    Heights heights() const { return heights_; }

    // A chunk is made from the top down to a section: those below are filled with kUnmade. New chunks are
    // made to the bottom.
    int lowestMade() const { return lowestMade_; }
    bool isMade(int section) const { return section >= lowestMade_; }
    // Forgets what is below a section.
    void unmakeBelow(int section);
    // Takes the sections below the lowest one that is made from `deeper`, which has the same heights; nothing
    // if that one is made no deeper.
    void makeDeeper(const Chunk& deeper);

    BlockId block(BlockIndex i) const { return section(sectionOf(i)).get(indexInSection(i)); }
    // Sets the block and resets its block state to 0; block entity data it had is freed.
    void setBlock(BlockIndex i, BlockId id);

    std::uint16_t blockState(BlockIndex i) const { return blockStates(sectionOf(i)).get(indexInSection(i)); }
    void setBlockState(BlockIndex i, std::uint16_t value);

    // The functions below access the block entity data of a block.
    const BlockEntityData* blockEntityData(BlockIndex i) const;  // null if the block has none
    BlockEntityDataPtr sharedBlockEntityData(BlockIndex i) const;
    void setBlockEntityData(BlockIndex i, BlockEntityData data);
    void shareBlockEntityData(BlockIndex i,
                              BlockEntityDataPtr data);  // not null; copies of the chunk share it
    void clearBlockEntityData(BlockIndex i);
    std::size_t blockEntityDataBytes() const;                   // of all blocks
    std::vector<BlockIndex> blocksWithBlockEntityData() const;  // in ascending order

    const Section& section(int number) const { return blocks_[place(number)]; }
    const Section& blockStates(int number) const { return blockState_[place(number)]; }
    // Replaces a whole section's blocks; its block state becomes 0, block entity data of its blocks is freed.
    void setSection(int number, Section section);
    void setBlockStateSection(int number, Section section);
    // Brings a section of block states to its smallest form; its values stay.
    void compactBlockState(int number) { blockState_[place(number)].compact(); }

    std::size_t memoryBytes() const;  // heap and object

    // Equal heights, and equal blocks with equal states and data.
    friend bool operator==(const Chunk& a, const Chunk& b);

  private:
    void requireSection(int number) const;
    std::size_t place(int number) const {
        assert(number >= heights_.firstSection() && number < heights_.endSection() &&
               "a section of the chunk");
        return static_cast<std::size_t>(number - heights_.firstSection());
    }

    Heights heights_;
    int lowestMade_;                            // section
    std::vector<Section> blocks_, blockState_;  // from the bottom
    std::unordered_map<BlockIndex, BlockEntityDataPtr> entityData_;
};

using ChunkPtr = std::shared_ptr<const Chunk>;

// Adds a chunk to the digest that `terrane generate --digest` prints and Python's World.digest() returns: its
// blocks by z, y, x, as 16-bit little-endian ids. Block state and block entity data do not count. The digest
// of an area takes its chunks by y, then x.
void addToDigest(base::Digest& digest, const Chunk& chunk);

}  // namespace terrane::world
