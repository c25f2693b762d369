// What opens and closes over the game: the menu, dialogs, the question before unsaved work is lost; and who
// has the mouse.
#pragma once

#include "apps/terrane/window/game_state.h"
#include "apps/terrane/window/pause_menu.h"
#include "apps/terrane/window/save_notice.h"

namespace terrane::app {

// Gives the mouse to the player, and closes what is open; or frees the cursor.
void captureMouse(GameState& game, bool isCaptured);
// Ends the loop.
void leave(GameState& game, bool toTitle);

// One press of Escape closes one thing, the last that opened; where nothing is open the game pauses.
void closeOne(GameState& game);
void answerPauseMenu(GameState& game, PauseChoice choice);

// Before anything is lost. Who closes the window is asked; who sends a signal is not there to answer: false.
bool askBeforeLoss(GameState& game);
void answerQuitDialog(GameState& game, QuitChoice choice);

}  // namespace terrane::app
