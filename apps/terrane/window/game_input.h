// What keys, mouse and gamepad do.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// All events since the frame before.
void handleEvents(GameState& game);
// The sticks turn, buttons do what keys and the mouse do.
void handlePad(GameState& game, double seconds);
// The keys and the stick that move the player now.
game::MoveKeys moveKeysOf(const GameState& game);

}  // namespace terrane::app
