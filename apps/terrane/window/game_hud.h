// What one sees of the game itself over the image: hand, hotbar, splinters, compass, where one is, and the
// dialogs of blocks and places.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// `seconds`: since the frame before.
void advanceHud(GameState& game, double seconds);
void drawHud(GameState& game, const Screen& screen, const render::Camera& camera, double seconds);

}  // namespace terrane::app
