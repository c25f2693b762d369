// Changes of blocks in a world, with what follows from them: a plant whose ground goes falls with it.
// terrane/game checks what players ask for and calls this; light, meshes and stores read the events.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

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
using BlockChange = std::variant<SetBlock, SetState, SetEntityData>;

// Event: a block changed. `before` equals `after` where only its data did.
struct BlockEdit {
    BlockPos pos;
    BlockId before = kAir, after = kAir;

    bool operator==(const BlockEdit&) const = default;
};

// Applies a change and appends one event for each block that changed, the one at `pos` first. Blocks that
// need ground (BlockType::needsGround) and lose it become air, upward until one stands. Appends nothing where
// no chunk is loaded, `pos` is above or below the world, or the block is there already. A block that needs
// ground and has none under it is not placed; a plant that grows is placed at its youngest stage. On the
// world's thread.
void applyChange(World& world, const BlockRegistry& registry, BlockPos pos, const BlockChange& change,
                 std::vector<BlockEdit>& edits);

}  // namespace terrane::world
