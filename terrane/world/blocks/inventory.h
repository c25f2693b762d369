// Stacks of items: of a player, or of a block with slots, such as a chest, in the block's block entity data.
// An edit by SetEntityData writes it back and saves it with the chunk. All are plain values; any thread may
// use them. Negative counts and names that do not fit throw std::invalid_argument.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/chunk.h"

namespace terrane::world {

// Items are stored by name, like block types in saves: a name keeps its meaning when ids change.
struct ItemStack {
    std::string item;  // empty: an empty slot
    std::uint16_t count = 0;
    std::uint16_t wear = 0;  // uses of a tool so far

    bool operator==(const ItemStack&) const = default;
};

constexpr std::uint16_t kMaxStack = 99;
constexpr std::size_t kMaxItemName = 255;  // bytes

using Inventory = std::vector<ItemStack>;  // a stack each slot

// Adds `count` items without wear to stacks of the same item that have room, then into empty slots, from the
// first on. `limit`: items that a stack of it holds. Returns the number of items that did not fit.
int addItems(Inventory& inventory, std::string_view item, int count, int limit = kMaxStack);
// Removes at most `count` items, from the last slot on. Returns the number of removed items.
int takeItems(Inventory& inventory, std::string_view item, int count);
// These do the same with one stack; nothing is added to a stack of another item or wear. Counts are 0 or more
// in all four functions.
int addToStack(ItemStack& stack, std::string_view item, int count, int limit = kMaxStack);
int takeFromStack(ItemStack& stack, int count);
// Returns the number of these items in the inventory.
int countItems(const Inventory& inventory, std::string_view item);

// Moves at most `count` items from a stack to another one of the same kind that has room, or to an empty one.
// Two stacks of different kinds change places if `count` is the whole stack. Returns whether anything
// changed.
bool moveItems(ItemStack& from, ItemStack& to, int count, int limit = kMaxStack);

// Encodes an inventory: a version, number of slots (16 bits), then of each slot the count (16 bits;
// little-endian both), in version 2 the wear (16 bits), the length of the name (8 bits) and the name. Names
// are at most kMaxItemName bytes. Version 1 is written unless an item has wear.
BlockEntityData encodeInventory(const Inventory& inventory);
// Returns the slots as the bytes have them; an error if the bytes are no such inventory.
[[nodiscard]] base::Result<Inventory> decodeSlots(const BlockEntityData& data);
// The items of a block. `slots`: the block's. Stacks of slots beyond them, which
// programs up to 0.2 accepted, move into empty slots; those that find none follow as further slots, so that
// all can be seen and taken out.
[[nodiscard]] base::Result<Inventory> decodeInventory(const BlockEntityData& data, int slots);

// Whether an edit may replace the items of a block by these: in as many slots as the block has, with stacks
// of at most kMaxStack and names without control characters. Of items that are not so, from older programs,
// there may be as many as before.
bool mayReplace(const Inventory& former, const Inventory& next, int slots);

// The data as a block with so many slots may get it: in a structure, for example. Stacks that find no room
// are left out. An error if the bytes are no inventory.
[[nodiscard]] base::Result<BlockEntityData> fittedInventory(const BlockEntityData& data, int slots);

}  // namespace terrane::world
