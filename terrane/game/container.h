// Blocks that hold items, such as chests: their items, and clicks on their slots.
#pragma once

#include <cstddef>

#include "terrane/game/session.h"
#include "terrane/world/inventory.h"

namespace terrane::game {

struct SlotClick {
    std::size_t slot = 0;
    bool takes = false;       // else puts the chosen block
    bool wholeStack = false;  // else one
};

// Whether a block holds items.
bool isContainer(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos);
// The items of the container at `pos`. An error if its data is no inventory.
base::Result<world::Inventory> itemsOf(const world::World& world, const world::BlockRegistry& blocks,
                                       world::BlockPos pos);

// Applies a click to `items`. Players have unlimited blocks: putting keeps `inHand`, taking sets it to the
// block of the item. False if nothing changed. Items that are no blocks of this program cannot be taken.
bool clickSlot(world::Inventory& items, const world::BlockRegistry& blocks, const SlotClick& click,
               world::BlockId& inHand);

// Sends a container's new items to the session.
EditResult putItems(Session& session, PlayerId player, world::BlockPos pos, const world::Inventory& items);

}  // namespace terrane::game
