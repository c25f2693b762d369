// The developer panel on the right side, with every setting. Immediate mode: draws and changes.
#pragma once

#include "apps/terrane/window/hud/overlay_layout.h"
#include "apps/terrane/window/settings/play_settings.h"
#include "terrane/game/player_state.h"

namespace terrane::app {

void drawPanel(OverlayLayout& layout, PlaySettings& settings, game::DayClock& day, bool isSoftwareRenderer);

}  // namespace terrane::app
