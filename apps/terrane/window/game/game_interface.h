// Draws the user interface over the image.
#pragma once

#include "apps/terrane/window/game/game_state.h"

namespace terrane::app {

// `seconds`: since the last frame.
void advanceHud(Hud& hud, const world::Pose& player, const PlaySettings& settings,
                const game::Session& session, double seconds);
// Call once per frame; also handles clicks. `seconds`: since the last frame.
void drawInterface(GameState& game, double seconds);

}  // namespace terrane::app
