// The dialog of an open chest: shows its items and handles clicks. Immediate mode: drawn each frame.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "apps/terrane/window/hud/overlay.h"
#include "terrane/base/result.h"
#include "terrane/game/items.h"
#include "terrane/game/session.h"

namespace terrane::app {

// The slots of an open chest in the middle of the window. Immediate mode: draws, and returns the click.
// Image and name of an item, by its name in the inventory.
struct ItemLooks {
    std::function<unsigned(const std::string&)> image;  // OpenGL texture, 0: none
    std::function<std::string(const std::string&)> name;
};

std::optional<game::SlotClick> drawContainer(const Screen& screen, const world::Inventory& items,
                                             const ItemLooks& looks, const Texts& tr);

// Whether the block is a container within reach of the player's eyes.
bool canUseContainer(const game::Session& session, world::BlockPos block, const glm::dvec3& eyes);

// Draws the items, and moves clicked ones between the chest and the hotbar. Fails if its items cannot be
// read.
base::Result<void> drawOpenContainer(const Screen& screen, game::Session& session, world::BlockPos block,
                                     game::Hotbar& hotbar, const ItemLooks& looks, const Texts& tr);

}  // namespace terrane::app
