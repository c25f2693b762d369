// The nine blocks of the hotbar, one of which is chosen. Plain values; any thread.
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
    std::size_t chosen = 0;

    world::BlockId block() const { return blocks[chosen]; }
    bool operator==(const Hotbar&) const = default;
};

// Whether players can build with it: not with air, "missing" and the upper halves of doors.
bool isBuilt(const world::BlockType& type, const world::BlockRegistry& blocks);

// The initial hotbar. Slots whose block the registry lacks get another one.
Hotbar firstHotbar(const world::BlockRegistry& blocks);

// Chooses the slot `steps` further, or back if negative, in a circle.
void stepSlot(Hotbar& hotbar, int steps);
// Chooses the slot that has the block, or puts the block into the chosen slot.
void takeInHand(Hotbar& hotbar, world::BlockId block);

// The number of the chosen slot and the names of the nine blocks: "0 oak_planks cobble …".
std::string textOf(const Hotbar& hotbar, const world::BlockRegistry& blocks);
// Reads any text; missing, unknown and unbuildable blocks stay as in firstHotbar().
Hotbar hotbarFrom(std::string_view text, const world::BlockRegistry& blocks);

// The blocks that a player can choose to build, filtered by group and search text. Plain functions.
// The groups of the blocks, in order of their first block in the registry.
std::vector<std::string> paletteGroups(const world::BlockRegistry& blocks);

struct PaletteFilter {
    std::string_view group;   // empty: all
    std::string_view search;  // each word is in the shown name or in the type's name; case is ignored
    std::function<std::string(world::BlockId)> shownName;
};
// In the order of the registry; blocks whose shown name begins with the first searched word come first.
std::vector<world::BlockId> paletteBlocks(const world::BlockRegistry& blocks, const PaletteFilter& filter);

// Blocks that hold items, such as chests: their items, and clicks on their slots.
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

// Whether an edit may give the block this data: for a container an inventory that world::mayReplace()
// accepts, or nothing. True for blocks that hold no items.
bool maySetItems(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos,
                 const world::BlockEntityData& data);

// Applies a click to `items`. Players have unlimited blocks: putting keeps `inHand`, taking sets it to the
// block of the item. False if nothing changed. Items that are no blocks of this program cannot be taken.
bool clickSlot(world::Inventory& items, const world::BlockRegistry& blocks, const SlotClick& click,
               world::BlockId& inHand);

// Sends a container's new items to the session.
EditResult putItems(Session& session, PlayerId player, world::BlockPos pos, const world::Inventory& items);

}  // namespace terrane::game
