// Liquids that flow (behavior `flows`): the values a cell takes from its neighbors, and the tick in which all
// cells that are not settled take their next value at once. Called by whoever runs the game, at a fixed rate,
// on the world's thread. All that a tick depends on is in the chunks, so it goes on after a world is loaded.
//
// Block state of a liquid that flows:
//
//   0–2  level: 0 a source, or falling; 1…7 so many blocks away from one
//   3    falling: there is liquid above. The cell is full
//   15   not settled: the cell and those beside and below it are looked at in the next tick
//
// Generated liquid has 0: it is a settled source, and stays as it is until a block beside it changes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrane/world/block_edit.h"

namespace terrane::world {

constexpr std::uint16_t kLiquidLevel = 7, kLiquidFalling = 8, kLiquidUnsettled = 1u << 15;
constexpr std::uint16_t kLiquidForm = kLiquidLevel | kLiquidFalling;  // 0: a source
constexpr int kMaxLiquidLevel = 7;
// Between two ticks of liquids: 0.25 s, in ticks of random_ticks.h.
constexpr int kTicksPerFlow = 5;
// Cells of a tick; the others wait for the next one. One takes 0.9 µs in a flood, 1.9 µs where each is a
// source that flows in all directions at once: 2 ms at most.
constexpr std::size_t kMaxFlowingCells = 1024;

constexpr bool isLiquidSource(std::uint16_t state) {
    return (state & kLiquidForm) == 0;
}

// Marks its cell as not settled when it is placed and when a block beside it changes.
BlockBehavior flows();
bool isFlowing(const BlockType& type);

// How high the liquid at `pos` stands in its cell, 0…1; 0 where there is none.
double liquidHeight(const World& world, const BlockRegistry& blocks, BlockPos pos);

// One tick of the cells of these chunks. A cell's next value is that of the first rule that holds:
//   1. A source stays one.
//   2. With two sources beside it, on ground or on a source, it becomes a source.
//   3. Under the same liquid it falls.
//   4. It is one level farther than the nearest neighbor that spreads, up to level 7. Sources spread, others
//      where they stand on ground.
//   5. It runs dry.
// Liquid flows into air and washes away what lets bodies pass and holds on to nothing: plants, torches. All
// next values are found before the first is written. Cells with a chunk within two blocks that is not loaded
// wait, and so do those over the limit, in the order of `chunks` and of blocks in a chunk. Returns
// how many cells were looked at, and appends an event for each block that changed and each that is settled
// now. `recorder` may be null.
std::size_t flowLiquids(World& world, const BlockRegistry& blocks, std::span<const ChunkPos> chunks,
                        std::vector<BlockEdit>& edits, BlockRecorder* recorder = nullptr);

}  // namespace terrane::world
