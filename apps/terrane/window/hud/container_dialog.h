// The dialog of an open chest in creative: shows its items and handles clicks. Immediate mode: drawn each
// frame.
#pragma once

#include <optional>

#include "apps/terrane/window/hud/item_view.h"
#include "apps/terrane/window/hud/overlay.h"
#include "terrane/base/result.h"
#include "terrane/game/items.h"
#include "terrane/game/session.h"

namespace terrane::app {

// Draws the slots of an open chest in the middle of the window, and returns the click.
std::optional<game::SlotClick> drawContainer(const Screen& screen, const world::Inventory& items,
                                             const world::ItemTable& table, const ItemLooks& looks,
                                             const Texts& tr);

// Whether the block is a container within reach of the player's eyes.
bool canUseContainer(const game::Session& session, world::BlockPos block, const glm::dvec3& eyes);

// Whether the block is a workbench within reach of the player's eyes.
bool canUseWorkbench(const game::Session& session, world::BlockPos block, const glm::dvec3& eyes);

// Draws the items, and moves clicked ones between the chest and the hotbar. Fails if its items cannot be
// read.
base::Result<void> drawOpenContainer(const Screen& screen, game::Session& session, world::BlockPos block,
                                     game::Hotbar& hotbar, const ItemLooks& looks, const Texts& tr);

}  // namespace terrane::app
