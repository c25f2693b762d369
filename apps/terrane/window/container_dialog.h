// The dialog of an open chest: shows its items and handles clicks. Immediate mode: drawn each frame.
#pragma once

#include "apps/terrane/window/container_panel.h"
#include "terrane/base/result.h"
#include "terrane/game/hotbar.h"
#include "terrane/game/session.h"

namespace terrane::app {

// Whether the block is a container within reach of the player's eyes.
bool canUseContainer(const game::Session& session, world::BlockPos block, const glm::dvec3& eyes);

// Draws the items, and moves clicked ones between the chest and the hotbar. Fails if its items cannot be
// read.
base::Result<void> drawOpenContainer(const Screen& screen, game::Session& session, world::BlockPos block,
                                     game::Hotbar& hotbar, const ItemLooks& looks, const Texts& tr);

}  // namespace terrane::app
