// Draws the HUD over the image: arm, hotbar, particles, compass, position, and the dialogs of blocks and
// places.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// `seconds`: since the last frame.
void advanceHud(GameState& game, double seconds);
void drawHud(GameState& game, const Screen& screen, const render::Camera& camera, double seconds);

}  // namespace terrane::app
