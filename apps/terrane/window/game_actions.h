// What the player does by a key or a button of a gamepad: looks, moves to places, takes edits back, writes
// pictures.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// Keys that are held do nothing here: see moveKeysOf().
void act(GameState& game, Action action);
void takeBack(GameState& game, game::HistoryWay way);
// Over the world's picture in the list of worlds, where it has one.
void writeThumbnailOf(GameState& game);

}  // namespace terrane::app
