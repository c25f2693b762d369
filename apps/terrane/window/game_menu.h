// Opens and closes the menu, dialogs and the question before unsaved data is lost; captures the mouse.
#pragma once

#include "apps/terrane/window/game_state.h"
#include "apps/terrane/window/pause_menu.h"
#include "apps/terrane/window/save_notice.h"

namespace terrane::app {

// Captures the mouse for the player and closes dialogs, or frees the cursor.
void captureMouse(GameState& game, bool isCaptured);
// Ends the loop.
void leave(GameState& game, bool toTitle);

// Closes the last thing that opened, for one press of Escape; if nothing is open, pauses the game.
void closeOne(GameState& game);
void answerPauseMenu(GameState& game, PauseChoice choice);

// Asks the player before unsaved data is lost; false, without asking, after a signal or if the player already
// agreed.
bool askBeforeLoss(GameState& game);
void answerQuitDialog(GameState& game, QuitChoice choice);

}  // namespace terrane::app
