// What players carry, and the modes of a world. All are plain values and pure functions; Session::act() is
// the door through which players change their items.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "terrane/base/result.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/coords.h"
#include "terrane/world/items/item_table.h"

namespace terrane::game {

enum class Mode : std::uint8_t {
    Creative,  // unlimited blocks, broken at once; fills, copies and undo
    Survival,  // players have what they find and make; breaking takes time
    Count
};
constexpr std::array<std::string_view, 2> kModeNames{"creative", "survival"};
std::optional<Mode> modeNamed(std::string_view name);

// Slots of a player: the hotbar, the others, and the grid of crafting, whose first two columns and rows are
// the grid of a player without a workbench. Items in the grid are kept like the others.
constexpr std::size_t kHotbarSlots = 9, kCarriedSlots = 36;
constexpr std::size_t kPlayerSlots = kCarriedSlots + world::kMaxGridSide * world::kMaxGridSide;
constexpr int kHandGridSide = 2;

struct PlayerItems {
    std::optional<Mode> mode = {};  // none: the world's
    world::Inventory slots = world::Inventory(kPlayerSlots);
    std::size_t selected = 0;  // slot of the hotbar; not stored

    const world::ItemStack& hand() const { return slots[selected]; }
    bool operator==(const PlayerItems&) const = default;
};

// Formats all but the selected slot: a line with the mode, then "SLOT COUNT WEAR NAME" of each stack.
std::string textOf(const PlayerItems& items);
// Parses any text; an error if it is no such text.
[[nodiscard]] base::Result<PlayerItems> parsePlayerItems(std::string_view text);

// Adds items to the slots that are no grid. Returns the number of items that did not fit.
int giveItems(PlayerItems& items, const world::ItemTable& table, const world::ItemStack& stack);
// Returns whether all of the stack would fit.
bool hasRoom(const PlayerItems& items, const world::ItemTable& table, const world::ItemStack& stack);

// Returns the stacks in a grid of 2 or 3 slots a side, by rows.
world::Inventory gridOf(const PlayerItems& items, int side);
// Makes what the grid gives and takes one item of each of its stacks. Returns the recipe; null, and nothing
// changes, if no recipe fits or its items have no room.
const world::Recipe* craft(PlayerItems& items, const world::ItemTable& table, int side);
// Wears the tool in the hand by one use; a worn out tool is gone.
void wearHand(PlayerItems& items, const world::ItemTable& table);

// A slot of the player, or of a block that holds items.
struct SlotPlace {
    std::optional<world::BlockPos> block = {};
    std::uint16_t slot = 0;

    bool operator==(const SlotPlace&) const = default;
};
// Moves at most `count` items (world::moveItems()).
struct MoveStack {
    SlotPlace from, to;
    std::uint16_t count = 0;

    bool operator==(const MoveStack&) const = default;
};
// Crafts once, on a workbench if there is one.
struct CraftItems {
    std::optional<world::BlockPos> workbench = {};

    bool operator==(const CraftItems&) const = default;
};
// Uses the item in the hand, which is no block: eats it, for example.
struct UseItem {
    bool operator==(const UseItem&) const = default;
};
struct SelectSlot {
    std::uint8_t slot = 0;

    bool operator==(const SelectSlot&) const = default;
};
using ItemAction = std::variant<MoveStack, CraftItems, UseItem, SelectSlot>;

// The mode of a world, in its metadata; creative unless it says otherwise.
Mode loadMode(store::ReadableStore& store);
void saveMode(store::ChunkStore& store, Mode mode);

}  // namespace terrane::game
