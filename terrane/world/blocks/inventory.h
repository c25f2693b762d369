// The items of a block with slots, such as a chest: stacks of items in the block's block entity data. An edit
// by SetEntityData writes it back and saves it with the chunk. Plain values, any thread. Negative counts and
// names that do not fit throw std::invalid_argument.
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

    bool operator==(const ItemStack&) const = default;
};

constexpr std::uint16_t kMaxStack = 99;
constexpr std::size_t kMaxItemName = 255;  // bytes

using Inventory = std::vector<ItemStack>;  // a stack each slot

// Puts `count` items into stacks of the same item that have room, then into empty slots, from the first on.
// Returns the number that found no room.
int addItems(Inventory& inventory, std::string_view item, int count);
// Takes at most `count` items, from the last slot on. Returns the number taken.
int takeItems(Inventory& inventory, std::string_view item, int count);
// The same with one stack; nothing is added to a stack of another item. Counts are 0 or more in all four.
int addToStack(ItemStack& stack, std::string_view item, int count);
int takeFromStack(ItemStack& stack, int count);
int countItems(const Inventory& inventory, std::string_view item);

// Bytes: version 1, number of slots (16 bits), then of each slot the count (16 bits; little-endian both), the
// length of the name (8 bits) and the name. Names are at most kMaxItemName bytes.
BlockEntityData encodeInventory(const Inventory& inventory);
// An error if the bytes are no such inventory. `slots`: the block's; items beyond them are kept.
[[nodiscard]] base::Result<Inventory> decodeInventory(const BlockEntityData& data, int slots);

}  // namespace terrane::world
