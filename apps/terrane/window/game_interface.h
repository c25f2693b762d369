// What the window's loop draws over the image.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// Once a frame; answers what is clicked. `seconds`: since the frame before.
void drawInterface(GameState& game, double seconds);

}  // namespace terrane::app
