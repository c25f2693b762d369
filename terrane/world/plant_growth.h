// Plants that grow: a block type with growth stages counts in its block state the stages that are left.
// Called by whoever runs the game, at a fixed rate.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::world {

// Ticks come every 50 ms; each takes kGrowthPicks blocks of each section at random. A block's turn comes
// every 4096 / 3 ticks, or 68 s, on average: wheat is grown after about three and a half minutes.
constexpr std::chrono::milliseconds kTickLength{50};
constexpr int kGrowthPicks = 3;

struct GrowthTick {
    std::uint64_t number = 0;  // of ticks before; the same world and number grow the same plants
    ChunkPos center;
    int radius = 8;  // chunks, Chebyshev
};

// The blocks that go on to their next stage in this tick: their block state is to be reduced by 1. Looks only
// into sections where some block has block state. On the world's thread.
std::vector<BlockPos> plantsThatGrow(const World& world, const BlockRegistry& blocks, const GrowthTick& tick);

}  // namespace terrane::world
