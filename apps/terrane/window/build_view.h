// The view of the game that building tools get: the session, and the player's pose, block and held keys.
#pragma once

#include <optional>

#include "apps/terrane/window/text.h"
#include "terrane/game/session.h"
#include "terrane/world/character.h"

namespace terrane::app {

struct BuildView {
    game::Session& session;
    const Texts& tr;
    world::Pose pose;
    std::optional<world::Aabb> body;  // none while the player flies through blocks
    world::BlockId hand = world::kAir;
    bool shift = false, control = false;  // keys that are held
};

}  // namespace terrane::app
