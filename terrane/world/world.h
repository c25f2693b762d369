// The chunks in memory and access to their blocks. It is used on one thread (the one that runs the game);
// chunks themselves are shared with workers as immutable snapshots: an edit (block_edit.h) replaces the chunk
// by a changed copy when a worker holds it.
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "terrane/world/chunk.h"

namespace terrane::world {

// The full value of a block, and the recorded values of blocks before a change: for undo, and for copies of
// blocks. All are plain values; any thread may use them.
class World;

struct BlockValue {
    BlockId id = kAir;
    std::uint16_t state = 0;
    BlockEntityDataPtr data;  // null: none

    friend bool operator==(const BlockValue& a, const BlockValue& b);  // data byte by byte
};

struct PlacedBlock {
    BlockPos pos;
    BlockValue value;
};

// Returns the value at `pos`; air above and below the world and where no chunk is loaded.
BlockValue blockValue(const World& world, BlockPos pos);

// Records the values of blocks before a change of the world (block_edit.h).
class BlockRecorder {
  public:
    // Records the value of a block. It is called before each write to the block.
    void note(BlockPos pos, BlockValue value) { notes_.push_back({pos, std::move(value)}); }
    // Returns each block once, with the value before its first write, chunk by chunk and in a chunk by block
    // index. The recorder is empty afterwards.
    std::vector<PlacedBlock> take();

  private:
    std::vector<PlacedBlock> notes_;
};

class World {
  public:
    World() = default;  // of the default heights
    explicit World(Heights heights) : heights_(heights) {}

    Heights heights() const { return heights_; }

    // Returns the chunk, or null unless it is loaded.
    ChunkPtr maybeChunkAt(ChunkPos pos) const;

    // Adds a chunk of the world's heights or replaces the one there. The world owns it from now on: the
    // caller may read through its pointer, but not write.
    void insert(ChunkPos pos, std::shared_ptr<Chunk> chunk);
    void erase(ChunkPos pos) { chunks_.erase(pos); }
    // Takes the sections of a deeper chunk that the chunk there does not have (chunk.h). The chunk is loaded.
    void makeDeeper(ChunkPos pos, const Chunk& deeper);

    // Returns whether the block can be read and written: its chunk is loaded and made as deep as it.
    bool isMade(BlockPos pos) const;

    // Returns a block; air above and below the world and where no chunk is loaded, kUnmade below what a chunk
    // is made to.
    BlockId block(BlockPos pos) const;

    // These return a block's 16 bits of block state and its block entity data. Where no chunk is loaded there
    // are none. A pointer is valid until the chunk changes or is erased.
    std::uint16_t blockState(BlockPos pos) const;
    const BlockEntityData* blockEntityData(BlockPos pos) const;  // null if the block has none

    std::size_t chunkCount() const { return chunks_.size(); }
    std::size_t memoryBytes() const;  // of all chunks
    // Calls use(ChunkPos, ChunkPtr) for each chunk, in no order.
    template <class Use>
    void forEachChunk(Use use) const {
        for (const auto& [pos, chunk] : chunks_) use(pos, ChunkPtr(chunk));
    }

  private:
    friend class BlockUpdate;  // of block_edit.h: the only way to a chunk that can be written
    friend BlockValue blockValue(const World&, BlockPos);

    const Chunk* findChunk(BlockPos pos) const;  // null above, below and where none is loaded
    Chunk* findWritable(BlockPos pos);           // the same; no snapshot shows what is written to it

    Heights heights_;
    std::unordered_map<ChunkPos, std::shared_ptr<Chunk>, ChunkPosHash> chunks_;
};

}  // namespace terrane::world
