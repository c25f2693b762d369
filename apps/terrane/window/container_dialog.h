// The dialog of an open chest: what is in it, and what clicks do. Immediate mode: drawn each frame.
#pragma once

#include "apps/terrane/window/container_panel.h"
#include "terrane/base/result.h"
#include "terrane/game/hotbar.h"
#include "terrane/game/session.h"

namespace terrane::app {

// Whether the chest is there, and within reach of the player's eyes.
bool canUseContainer(const game::Session& session, world::BlockPos block, const glm::dvec3& eyes);

// Draws what is in it, and moves what is clicked between it and the hand. An error: its items cannot be read.
base::Result<void> drawOpenContainer(const Screen& screen, game::Session& session, world::BlockPos block,
                                     game::Hotbar& hotbar, const ItemLooks& looks, const Texts& tr);

}  // namespace terrane::app
