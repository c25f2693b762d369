// What a person does with a chest: which block opens, what it holds, what a click on a slot does. Free of the
// user interface: chest_panel.h draws.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "terrane/stream/chunk_pipeline.h"
#include "terrane/world/inventory.h"

namespace terrane::app {

struct SlotClick {
    std::size_t slot = 0;
    bool takes = false;       // else puts what is in the hand
    bool wholeStack = false;  // else one
};

// Whether a block holds items.
bool isChest(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos);
// What the chest at `pos` holds. An error where its data is no inventory.
base::Result<world::Inventory> itemsOf(const world::World& world, const world::BlockRegistry& blocks,
                                       world::BlockPos pos);

// The hand has no end of blocks: what is put does not leave it, and what is taken is what it holds next.
// False where nothing changed. Items that are no blocks of this program stay where they are.
bool clickSlot(world::Inventory& items, const world::BlockRegistry& blocks, const SlotClick& click,
               world::BlockId& inHand);

}  // namespace terrane::app
