// What the panel of statistics and the file of --collect-perf-data tell of a frame.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// Memory as of the last half second: finding it goes through all chunks. Points into `game`.
Statistics statisticsOf(GameState& game);

}  // namespace terrane::app
