// The nine blocks of the hotbar, one of which is chosen. Plain values; any thread.
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

}  // namespace terrane::game
