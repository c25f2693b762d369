// Selects the blocks of a random tick: blocks whose behavior has `tick`, such as growing plants. The session
// calls it at a fixed rate.
#pragma once

#include <chrono>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::world {

// Ticks happen every 50 ms; each takes kTickPicks blocks of each section at random. A block is taken every
// 4096
// / 3 ticks, or 68 s, on average: wheat is grown after about three and a half minutes.
constexpr std::chrono::milliseconds kTickLength{50};
constexpr int kTickPicks = 3;

// Ticks reach this far around a player: chunks, Chebyshev.
constexpr int kTickRadius = 8;

// Returns the blocks of these chunks to be changed by RunTick (block_edit.h); chunks that are not loaded have
// none. `tick`: the number of ticks before; the same world and number give the same blocks. Reads only
// sections in which some block has block state: a block whose state is 0 is at rest. It is used on the
// world's thread.
std::vector<BlockPos> blocksToTick(const World& world, const BlockRegistry& blocks, std::uint64_t tick,
                                   std::span<const ChunkPos> chunks);
// Returns the blocks of these kinds that the same rule picks, whatever their state.
std::vector<BlockPos> blocksOfKinds(const World& world, const std::set<BlockId>& kinds, std::uint64_t tick,
                                    std::span<const ChunkPos> chunks);

}  // namespace terrane::world
