// Handles keys, mouse and gamepad.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// Handles all events since the last frame.
void handleEvents(GameState& game);
// Sticks turn the view; buttons do the same as keys and mouse buttons.
void handlePad(GameState& game, double seconds);
// While a key of time is held, a day passes in ten seconds.
void passHeldTime(GameState& game, double seconds);
// The state of the keys and the stick that move the player.
game::MoveKeys moveKeysOf(const GameState& game);

}  // namespace terrane::app
