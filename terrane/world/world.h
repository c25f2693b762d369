// The chunks in memory and access to their blocks. Used on one thread (the one that runs the game); chunks
// themselves are shared with workers as immutable snapshots: an edit replaces the chunk by a changed copy
// when a worker holds it.
#pragma once

#include <cstdint>
#include <unordered_map>

#include "terrane/world/chunk.h"

namespace terrane::world {

class World {
  public:
    // The chunk, or null unless it is loaded.
    ChunkPtr maybeChunkAt(ChunkPos pos) const;

    // Adds a chunk or replaces the one there. The chunk must not have been created as a constant object.
    void insert(ChunkPos pos, ChunkPtr chunk);
    void erase(ChunkPos pos) { chunks_.erase(pos); }

    // Air above and below the world and where no chunk is loaded.
    BlockId block(BlockPos pos) const;
    // False where no chunk is loaded or pos.z is outside the world; then nothing changes.
    bool setBlock(BlockPos pos, BlockId id);

    // A block's 16 bits of small data, and the bytes it keeps beyond them. Where no chunk is loaded there are
    // none, and setting returns false. What belongs to a block goes when setBlock replaces it. A pointer
    // holds until the chunk changes or goes.
    std::uint16_t smallData(BlockPos pos) const;
    bool setSmallData(BlockPos pos, std::uint16_t value);  // large data the block had goes
    const LargeData* largeData(BlockPos pos) const;        // null where the block has none
    bool setLargeData(BlockPos pos, LargeData data);
    bool clearLargeData(BlockPos pos);

    const std::unordered_map<ChunkPos, ChunkPtr, ChunkPosHash>& chunks() const { return chunks_; }
    std::size_t memoryBytes() const;  // of all chunks

  private:
    const Chunk* findChunk(BlockPos pos) const;  // null above, below and where none is loaded
    Chunk* findWritable(BlockPos pos);           // the same

    std::unordered_map<ChunkPos, ChunkPtr, ChunkPosHash> chunks_;
};

}  // namespace terrane::world
