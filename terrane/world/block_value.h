// The full value of a block, and the recorded values of blocks before a change: for undo, and for copies of
// blocks. Plain values; any thread.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "terrane/world/chunk.h"

namespace terrane::world {

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

// The value at `pos`; air above and below the world and where no chunk is loaded.
BlockValue blockValue(const World& world, BlockPos pos);

// Records the values of blocks before a change of the world (block_edit.h).
class BlockRecorder {
  public:
    // Called before each write to a block.
    void note(BlockPos pos, BlockValue value) { notes_.push_back({pos, std::move(value)}); }
    // Each block once, with the value before its first write, chunk by chunk and in a chunk by block index.
    // The recorder is empty afterwards.
    std::vector<PlacedBlock> take();

  private:
    std::vector<PlacedBlock> notes_;
};

}  // namespace terrane::world
