// The dialog of a player's items in survival: all slots, and the grid of crafting or an open chest. What the
// mouse carries stays in its slot until it is put down, so nothing is lost when the dialog closes.
// Immediate mode: drawn each frame.
#pragma once

#include <optional>
#include <vector>

#include "apps/terrane/window/hud/item_view.h"
#include "apps/terrane/window/hud/overlay.h"
#include "terrane/game/session.h"

namespace terrane::app {

struct InventoryState {
    // What the mouse carries.
    struct Carried {
        game::SlotPlace from;
        std::uint16_t count = 0;
        bool isDragged = false;  // since its button went down
    };

    bool isOpen = false;                       // without a chest
    std::optional<world::BlockPos> workbench;  // whose grid is shown; none: the player's own
    std::optional<Carried> carried;
};

// Draws the dialog, of a chest too if there is one, and returns what the player does with items.
std::vector<game::ItemAction> drawInventory(const Screen& screen, const game::Session& session,
                                            std::optional<world::BlockPos> chest, InventoryState& state,
                                            const ItemLooks& looks, const Texts& tr);

// Returns the moves that clear the grid of crafting, when the dialog closes.
std::vector<game::ItemAction> clearGrid(const game::PlayerItems& items, const world::ItemTable& table);

}  // namespace terrane::app
