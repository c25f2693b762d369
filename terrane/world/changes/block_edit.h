// Changes of blocks in a world and their consequences by the behaviors of blocks (block_behavior.h): a plant
// is removed with its ground, sand falls. terrane/game checks commands of players and calls this; light,
// meshes and stores read the events.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <variant>
#include <vector>

#include "terrane/world/blocks/block_behavior.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/coords.h"
#include "terrane/world/world.h"

namespace terrane::world {

// A set of blocks: a bit for each block, 512 bytes for each section that has some. A hash set of a hundred
// thousand blocks would not fit the caches. It is a plain value.
class BlockSet {
  public:
    // Adds a block and returns whether it is new in the set.
    bool insert(BlockPos pos) {
        auto bit = sections_[sectionOf(pos)][indexOf(pos)];
        const bool isNew = !bit;
        bit = true;
        return isNew;
    }
    bool contains(BlockPos pos) const {
        const auto found = sections_.find(sectionOf(pos));
        return found != sections_.end() && found->second[indexOf(pos)];
    }

  private:
    static BlockPos sectionOf(BlockPos pos) { return {pos.x >> 4, pos.y >> 4, pos.z >> 4}; }
    static std::size_t indexOf(BlockPos pos) {
        return static_cast<std::size_t>(indexInSection(blockIndex(pos)));
    }

    std::unordered_map<BlockPos, std::bitset<kBlocksPerSection>, BlockPosHash> sections_;  // by section
};

// The kinds of changes of a block.
struct SetBlock {
    BlockId id = kAir;
    std::uint16_t state = 0;  // behaviors may set another; 0 leaves the state of the same block as it is
};
struct SetState {  // its 16 bits of block state
    std::uint16_t value = 0;
};
struct SetEntityData {  // the bytes it keeps beyond them
    BlockEntityData data;
};
struct RunTick {};   // calls the `tick` of its behaviors
struct UseBlock {};  // calls their `used`
using BlockChange = std::variant<SetBlock, SetState, SetEntityData, RunTick, UseBlock>;

// Event: a block changed. `before` equals `after` if only its state or data changed. A moving block has two
// events.
struct BlockEdit {
    BlockPos pos;
    BlockId before = kAir, after = kAir;

    bool operator==(const BlockEdit&) const = default;
};

// Whether a change at `from` may have consequences at `to`, a block beside it.
using MayReach = std::function<bool(BlockPos from, BlockPos to)>;

// The limit of functions of behaviors that run in one change; further calls are omitted. A column of 4,095
// falling blocks needs 4,095 × 14.
constexpr std::size_t kMaxBehaviorCalls = 65536;

// Selects the blocks set by restore() whose `neighborChanged` is called.
enum class RestoreScope : std::uint8_t {
    None,    // none: the consequences are known already
    Border,  // those that touch a block which is not restored: nothing inside falls or is removed
    All,     // all: fences get their arms, plants without ground are removed
};

// A change of the world in progress: each change appends its event and queues the behaviors to call; run()
// calls them in this order until the queue is empty. Nothing happens where no chunk is loaded or made
// (World::isMade()), above and below the world. It is used on the world's thread.
class BlockUpdate {
  public:
    // `recorder` and `mayReach` may be null. Neighbors that a change may not reach are not told of it.
    BlockUpdate(World& world, const BlockRegistry& blocks, std::vector<BlockEdit>& edits,
                BlockRecorder* recorder = nullptr, const MayReach* mayReach = nullptr)
        : world_(world),
          blocks_(blocks),
          edits_(edits),
          recorder_(recorder),
          mayReach_(mayReach),
          firstEdit_(edits.size()) {}

    const World& world() const { return world_; }
    const BlockRegistry& blocks() const { return blocks_; }

    void change(BlockPos pos, const BlockChange& change);
    // Moves a block with its data; `from` becomes air. Calls neither `placed` nor `removed` of it. The block
    // stays where it is if it cannot stand at `to`.
    void move(BlockPos from, BlockPos to);
    // Sets exactly these blocks (each position once) without calling `canStand`, `placed` and `removed`.
    // Calls `neighborChanged` for blocks that touch one of them, and for these by `scope`; these calls do not
    // count toward kMaxBehaviorCalls.
    void restore(std::span<const PlacedBlock> blocks, RestoreScope scope = RestoreScope::Border);
    // Compacts the block states of the section at `pos`: its palette has only states that are in use.
    void compactState(BlockPos pos);

    void run();

  private:
    struct Call {
        std::function<void(BlockUpdate&, BlockPos)> BlockBehavior::*simple = nullptr;  // placed, tick or used
        BlockPos pos;
        BlockId id = kAir;       // the call is left out if another block is there by then
        Face side = kFaceCount;  // of neighborChanged
        RemovedBlock removed;    // of `removed`
    };
    void setBlock(BlockPos pos, const SetBlock& block);
    void setValue(BlockPos pos, const BlockValue& value);
    void setData(BlockPos pos, const BlockChange& change);
    bool canStand(BlockPos pos, BlockId id) const;
    void write(Chunk& chunk, BlockPos pos, BlockId id);
    bool hasEdit(BlockPos pos);
    void noteNeighbors(BlockPos pos);
    void noteChangedSide(BlockPos pos, Face side);
    void record(BlockPos pos);
    void runCall(const Call& call);

    World& world_;
    const BlockRegistry& blocks_;
    std::vector<BlockEdit>& edits_;
    BlockRecorder* recorder_;
    const MayReach* mayReach_;
    std::size_t firstEdit_;
    BlockSet edited_;  // blocks of the first inSet_ edits since firstEdit_
    std::size_t inSet_ = 0;
    std::vector<Call> calls_;
    std::size_t maxCalls_ = kMaxBehaviorCalls;
};

// Applies a change with its consequences and appends one event for each block that changed, the one at `pos`
// first; none if it cannot be applied or changes nothing. `recorder`, if given, gets the old values of
// blocks.
void applyChange(World& world, const BlockRegistry& registry, BlockPos pos, const BlockChange& change,
                 std::vector<BlockEdit>& edits, BlockRecorder* recorder = nullptr,
                 const MayReach* mayReach = nullptr);
// Does the same for BlockUpdate::restore(), for undo.
void restoreBlocks(World& world, const BlockRegistry& registry, std::span<const PlacedBlock> blocks,
                   std::vector<BlockEdit>& edits, BlockRecorder* recorder = nullptr);

}  // namespace terrane::world
