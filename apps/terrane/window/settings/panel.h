// The developer panel on the right side, with every setting. Immediate mode: draws and changes.
#pragma once

#include "apps/terrane/window/settings/play_settings.h"
#include "terrane/game/player_state.h"

namespace terrane::app {

struct PanelInput {
    bool isSoftwareRenderer = false;
    float width = 0, height = 0;  // of the window
};

float panelWidth();  // call during a frame
void drawPanel(PlaySettings& settings, game::DayClock& day, const PanelInput& input);

}  // namespace terrane::app
