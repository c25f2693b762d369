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

    const std::unordered_map<ChunkPos, ChunkPtr, ChunkPosHash>& chunks() const { return chunks_; }
    std::size_t memoryBytes() const;  // of all chunks

  private:
    std::unordered_map<ChunkPos, ChunkPtr, ChunkPosHash> chunks_;
};

}  // namespace terrane::world
