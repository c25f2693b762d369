// Changes of blocks in a world, with what follows from them by the behaviors of blocks (block_behavior.h): a
// plant goes with its ground, sand falls.
// terrane/game checks what players ask for and calls this; light, meshes and stores read the events.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "terrane/world/block_behavior.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::world {

// What can be done to a block.
struct SetBlock {
    BlockId id = kAir;
};
struct SetState {  // its 16 bits of block state
    std::uint16_t value = 0;
};
struct SetEntityData {  // the bytes it keeps beyond them
    BlockEntityData data;
};
struct RunTick {};  // calls the `tick` of its behaviors
using BlockChange = std::variant<SetBlock, SetState, SetEntityData, RunTick>;

// Event: a block changed. `before` equals `after` where only its data did. A block that moves has two.
struct BlockEdit {
    BlockPos pos;
    BlockId before = kAir, after = kAir;

    bool operator==(const BlockEdit&) const = default;
};

// At most so many functions of behaviors run in one change; those after them are left out. A column of 255
// blocks that fall needs 255 × 14.
constexpr std::size_t kMaxBehaviorCalls = 16384;

// A change of the world in progress, with what follows from it: each change appends its event and notes which
// behaviors are to be called, run() calls them in the order in which they were noted. What they change is
// noted behind that. Nothing happens where no chunk is loaded, above or below the world. On the world's
// thread.
class BlockUpdate {
  public:
    BlockUpdate(World& world, const BlockRegistry& blocks, std::vector<BlockEdit>& edits)
        : world_(world), blocks_(blocks), edits_(edits), firstEdit_(edits.size()) {}

    const World& world() const { return world_; }
    const BlockRegistry& blocks() const { return blocks_; }

    void change(BlockPos pos, const BlockChange& change);
    // Moves a block with its data; `from` becomes air. Calls neither `placed` nor `removed` of it. The block
    // stays where it is if it cannot stand at `to`.
    void move(BlockPos from, BlockPos to);

    void run();

  private:
    struct Call {
        std::function<void(BlockUpdate&, BlockPos)> BlockBehavior::*simple = nullptr;  // placed or tick
        BlockPos pos;
        BlockId id = kAir;       // the call is left out where the block is another by then
        Face side = kFaceCount;  // of neighborChanged
        RemovedBlock removed;    // of `removed`
    };
    void setBlock(BlockPos pos, BlockId id);
    void setData(BlockPos pos, const BlockChange& change);
    bool canStand(BlockPos pos, BlockId id) const;
    void write(Chunk& chunk, BlockPos pos, BlockId id);
    void noteNeighbors(BlockPos pos);
    void runCall(const Call& call);

    World& world_;
    const BlockRegistry& blocks_;
    std::vector<BlockEdit>& edits_;
    std::size_t firstEdit_;
    std::vector<Call> calls_;
};

// Applies a change with all that follows from it, and appends one event for each block that changed, the one
// at `pos` first; none where it cannot be applied or the block is there already.
void applyChange(World& world, const BlockRegistry& registry, BlockPos pos, const BlockChange& change,
                 std::vector<BlockEdit>& edits);

}  // namespace terrane::world
