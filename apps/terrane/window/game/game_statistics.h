// Statistics of a frame, for the panel and for the file of --collect-perf-data.
#pragma once

#include "apps/terrane/window/game/game_state.h"

namespace terrane::app {

// Memory is measured twice a second, since that visits all chunks. The result points into `game`.
Statistics statisticsOf(GameState& game);

}  // namespace terrane::app
