// Changes of blocks with what follows from them: a plant whose ground goes falls with it.
#pragma once

#include <vector>

#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::world {

// A block that changed, and what it was before.
struct BlockUpdate {
    BlockPos pos;
    BlockId before = kAir;
};

// Puts `id` at `pos`; blocks that need ground (BlockType::needsGround) and lose it become air, upward until
// one stands. Returns all that changed, `pos` first; nothing where no chunk is loaded, `pos` is above or
// below the world, or the block is there already. A block that needs ground and has none under it is not
// placed; a plant that grows is placed at its youngest stage. On the world's thread.
std::vector<BlockUpdate> updateBlock(World& world, const BlockRegistry& registry, BlockPos pos, BlockId id);

}  // namespace terrane::world
