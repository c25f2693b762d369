// The nine blocks that a player has at hand, one of which is in the hand. Plain values; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "terrane/world/block_registry.h"

namespace terrane::game {

struct Hotbar {
    static constexpr std::size_t kSlots = 9;

    std::array<world::BlockId, kSlots> blocks{};  // air: an empty slot
    std::size_t chosen = 0;

    world::BlockId block() const { return blocks[chosen]; }
    bool operator==(const Hotbar&) const = default;
};

// Whether players build with it: air, "missing" and the upper halves of doors are not built.
bool isBuilt(const world::BlockType& type, const world::BlockRegistry& blocks);

// Blocks to begin with. Slots whose block the registry lacks get another one.
Hotbar firstHotbar(const world::BlockRegistry& blocks);

// The next slot, around in a circle; below 0 the one before.
void stepSlot(Hotbar& hotbar, int steps);
// The slot that has the block is chosen; where none has it, the chosen slot takes it.
void takeInHand(Hotbar& hotbar, world::BlockId block);

// The number of the chosen slot and the names of the nine blocks: "0 oak_planks cobble …".
std::string textOf(const Hotbar& hotbar, const world::BlockRegistry& blocks);
// Reads any text: what is missing, unknown or not built stays as in firstHotbar().
Hotbar hotbarFrom(std::string_view text, const world::BlockRegistry& blocks);

}  // namespace terrane::game
