// Draws the user interface over the image.
#pragma once

#include "apps/terrane/window/game/game_state.h"

namespace terrane::app {

// `seconds`: since the last frame.
void advanceHud(Hud& hud, const world::Pose& player, const PlaySettings& settings,
                const game::Session& session, double seconds);
// Call once per frame; also handles clicks. `seconds`: since the last frame.
void drawInterface(GameState& game, double seconds);

// Statistics of a frame, for the panel and for the file of --collect-perf-data. Memory is measured twice a
// second, since that visits all chunks. The result points into `game`.
Statistics statisticsOf(GameState& game);

}  // namespace terrane::app
