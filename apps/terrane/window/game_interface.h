// Draws the user interface over the image.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// Call once per frame; also handles clicks. `seconds`: since the last frame.
void drawInterface(GameState& game, double seconds);

}  // namespace terrane::app
