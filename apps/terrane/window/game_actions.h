// Actions of the player: break and build, undo, and everything bound to keys; also the world's thumbnail.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// Does nothing for actions of held keys: see moveKeysOf().
void act(GameState& game, Action action);
// Breaks or builds while a button is held; shows it with the arm and particles. `seconds`: since the last
// frame.
void breakAndBuild(GameState& game, double seconds);
void takeBack(GameState& game, game::HistoryWay way);
// Writes the thumbnail for the list of worlds over the last one. Does nothing if the world has no file for
// it.
void writeThumbnailOf(GameState& game);

}  // namespace terrane::app
