// Blocks that hold items, such as chests: which block opens, what it holds, what a click on a slot does.
#pragma once

#include <cstddef>

#include "terrane/game/session.h"
#include "terrane/world/inventory.h"

namespace terrane::game {

struct SlotClick {
    std::size_t slot = 0;
    bool takes = false;       // else puts the block in hand
    bool wholeStack = false;  // else one
};

// Whether a block holds items.
bool isContainer(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos);
// What the container at `pos` holds. An error where its data is no inventory.
base::Result<world::Inventory> itemsOf(const world::World& world, const world::BlockRegistry& blocks,
                                       world::BlockPos pos);

// Changes `items` as the click says. Players have no end of blocks: putting leaves `inHand` as it is, and
// what is taken is what the player holds next. False where nothing changed. Items that are no blocks of this
// program stay where they are.
bool clickSlot(world::Inventory& items, const world::BlockRegistry& blocks, const SlotClick& click,
               world::BlockId& inHand);

// Sends a container's new items to the session.
EditResult putItems(Session& session, PlayerId player, world::BlockPos pos, const world::Inventory& items);

}  // namespace terrane::game
