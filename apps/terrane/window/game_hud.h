// What one sees of the game itself over the image: hand, hotbar, splinters, compass, where one is, and the
// dialogs of blocks and places. Breaking and building lies here, too, since the hand and splinters show it.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// Breaks and builds where a button is held, and moves on what is shown. `seconds`: since the frame before.
void advanceHud(GameState& game, double seconds);
void drawHud(GameState& game, const Screen& screen, const render::Camera& camera, double seconds);

}  // namespace terrane::app
