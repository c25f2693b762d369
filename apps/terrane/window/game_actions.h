// What the player does: breaks and builds, takes edits back, and all that a key is for; and the world's
// picture.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// Keys that are held do nothing here: see moveKeysOf().
void act(GameState& game, Action action);
// Where a button is held; the hand and splinters show it. `seconds`: since the frame before.
void breakAndBuild(GameState& game, double seconds);
void takeBack(GameState& game, game::HistoryWay way);
// For the list of worlds, over the one before. Nothing where the world has no file for it.
void writeThumbnailOf(GameState& game);

}  // namespace terrane::app
