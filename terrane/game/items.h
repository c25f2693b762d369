// The nine blocks of the hotbar, one of which is selected. A plain value; any thread may use it.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/game/session.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/blocks/inventory.h"

namespace terrane::game {

struct Hotbar {
    static constexpr std::size_t kSlots = 9;

    std::array<world::BlockId, kSlots> blocks{};  // air: an empty slot
    std::size_t selected = 0;

    world::BlockId block() const { return blocks[selected]; }
    bool operator==(const Hotbar&) const = default;
};

// Returns whether players can build with it: not with air, "missing" and the upper halves of doors.
bool isBuildable(const world::BlockType& type, const world::BlockRegistry& blocks);

// Returns the initial hotbar. Slots whose block the registry lacks get another one.
Hotbar defaultHotbar(const world::BlockRegistry& blocks);

// Selects the slot `steps` further, or back if negative, and wraps around.
void cycleSlot(Hotbar& hotbar, int steps);
// Selects the slot that has the block, or puts the block into the selected slot.
void selectBlock(Hotbar& hotbar, world::BlockId block);

// Returns the number of the selected slot and the names of the nine blocks: "0 oak_planks cobble …".
std::string textOf(const Hotbar& hotbar, const world::BlockRegistry& blocks);
// Parses any text; missing, unknown and unbuildable blocks stay as in defaultHotbar().
Hotbar parseHotbar(std::string_view text, const world::BlockRegistry& blocks);

// Returns the groups of the blocks that a player can build with, in order of their first block in the
// registry.
std::vector<std::string> paletteGroups(const world::BlockRegistry& blocks);

struct PaletteFilter {
    std::string_view group;   // empty: all
    std::string_view search;  // each word is in the shown name or in the type's name; case is ignored
    std::function<std::string(world::BlockId)> displayName;
};
// Returns the blocks that pass the filter, in the order of the registry; blocks whose display name begins
// with the first searched word come first.
std::vector<world::BlockId> paletteBlocks(const world::BlockRegistry& blocks, const PaletteFilter& filter);

// A click on a slot of a block that holds items, such as a chest.
struct SlotClick {
    std::size_t slot = 0;
    bool takes = false;       // else puts the chosen block
    bool wholeStack = false;  // else one
};

// Returns whether a block holds items.
bool isContainer(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos);
// Returns the items of the container at `pos`, or an error if its data is no inventory.
base::Result<world::Inventory> itemsOf(const world::World& world, const world::BlockRegistry& blocks,
                                       world::BlockPos pos);

// Whether an edit may give the block this data: for a container an inventory that world::mayReplace()
// accepts, or nothing. True for blocks that hold no items.
bool maySetItems(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos,
                 const world::BlockEntityData& data);

// Applies a click to `items`. Players have unlimited blocks: putting keeps `heldBlock`, taking sets it to the
// block of the item. False if nothing changed. Items that are no blocks of this program cannot be taken.
bool clickSlot(world::Inventory& items, const world::BlockRegistry& blocks, const SlotClick& click,
               world::BlockId& heldBlock);

// Sends a container's new items to the session.
EditResult putItems(Session& session, PlayerId player, world::BlockPos pos, const world::Inventory& items);

}  // namespace terrane::game
