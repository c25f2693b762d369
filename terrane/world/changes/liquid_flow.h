// Flowing liquids (behavior `flows`): a tick computes the next value of all unsettled cells from their
// neighbors, and sets all at once. It is called at a fixed rate on the world's thread. A tick depends only on
// the chunks, so flow goes on after a world is loaded.
//
// Block state of a liquid that flows:
//
//   0–2  level: 0 a source, or falling; 1…7 so many blocks away from one
//   3    falling: there is liquid above. The cell is full
//   15   not settled: the cell and those beside and below it are computed in the next tick
//
// Generated liquid has 0: it is a settled source, and stays until a block beside it changes.
//
// Blocks with the behavior `falling` have bit 15 while they lie on ground that is not made.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/world/changes/block_edit.h"

namespace terrane::world {

constexpr std::uint16_t kLiquidLevel = 7, kLiquidFalling = 8, kUnsettled = 1u << 15;
constexpr std::uint16_t kLiquidForm = kLiquidLevel | kLiquidFalling;  // 0: a source
constexpr int kMaxLiquidLevel = 7;
// Ticks of random_ticks.h from one tick of liquids to the next: 0.25 s.
constexpr int kTicksPerFlow = 5;
// Cells of a tick; the others wait for the next one. One takes 0.9 µs in a flood, 1.9 µs if each is a source
// that flows in all directions at once: 2 ms at most.
constexpr std::size_t kMaxFlowingCells = 1024;

constexpr bool isLiquidSource(std::uint16_t state) {
    return (state & kLiquidForm) == 0;
}

// Returns the behavior, which marks its cell as unsettled when it is placed and when an adjacent block
// changes.
BlockBehavior flows();
bool isFlowing(const BlockType& type);

// Returns the height of the liquid in the cell at `pos`, 0…1; 0 if there is none.
double liquidHeight(const World& world, const BlockRegistry& blocks, BlockPos pos);

// Who made liquid flow, such as a player: whose edit let cells flow that were at rest. 0: nobody, as in a
// world that was loaded while liquid flowed.
using FlowCause = std::uint64_t;

// For a history of who changed what. The caller keeps the causes from tick to tick, and adds those of cells
// that an edit unsettles.
struct FlowRecord {
    // The most cells whose cause is known: 65,536 × about 64 bytes = 4 MB. In a larger flood, causes are
    // forgotten: cause 0.
    static constexpr std::size_t kMaxCauses = 65536;

    std::unordered_map<BlockPos, FlowCause, BlockPosHash> causes;  // of unsettled cells
    std::map<FlowCause, BlockRecorder> changes;                    // of the last tick

    // Notes who unsettled the cells of these edits that hold flowing liquid.
    void note(const World& world, const BlockRegistry& blocks, std::span<const BlockEdit> edits,
              FlowCause cause);

  private:
    void forgetOthers(const World& world, const BlockRegistry& blocks);
};

// Limits of a tick, and what is recorded of it. Plain values; the pointers may be null.
struct FlowOptions {
    const MayReach* mayReach = nullptr;  // for the liquid itself, and for what its flow changes
    FlowRecord* record = nullptr;
};

// One tick of the cells of these chunks. A cell's next value is that of the first rule that holds:
//   1. A source stays one.
//   2. With two sources beside it, on ground or on a source, it becomes a source.
//   3. Under the same liquid it falls.
//   4. It is one level farther than the nearest neighbor that spreads, up to level 7. Sources spread, others
//      where they stand on ground.
//   5. It runs dry.
// Liquid flows into air and washes away loose blocks that bodies can pass: plants, torches. All next values
// are computed before the first is written. Cells with a chunk within two blocks that is not loaded wait, and
// so do those over the limit, in the order of `chunks` and of blocks in a chunk. Falling
// blocks that are not settled fall on if the block below is made. Returns the number of computed cells and
// of these blocks, and appends an event for each block that changed and each that is settled now.
std::size_t flowLiquids(World& world, const BlockRegistry& blocks, std::span<const ChunkPos> chunks,
                        std::vector<BlockEdit>& edits, const FlowOptions& options = {});

}  // namespace terrane::world
