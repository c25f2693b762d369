// What a user can change while playing, and how it is written down. Shown by panel.h, kept by settings.h.
#pragma once

#include <string>

#include "apps/terrane/graphics_options.h"
#include "apps/terrane/window/settings.h"
#include "terrane/game/player.h"
#include "terrane/mesh/mesh_options.h"
#include "terrane/render/frame_input.h"
#include "terrane/render/graphics_table.h"

namespace terrane::app {

struct PlaySettings {
    std::string preset = "auto";
    render::GraphicsSettings graphics;  // the preset's, with changes
    render::View view = render::View::Color;
    game::Movement movement = game::Movement::Gravity;
    float fieldOfView = 70;          // degrees
    float mouseSensitivity = 0.15f;  // degrees a screen unit
    double dayMinutes = 20;
    bool fullScreen = false;
    float soundVolume = 0.6f;       // 0: none
    std::string resourcePack;       // folder; empty: none
    std::string language = "auto";  // of --language (text.h)

    bool operator==(const PlaySettings&) const = default;
};

EnumNames<game::Movement> movementNames();  // of the option --movement

// As options of `terrane play`: of the graphics options only those that differ from the preset.
SettingValues valuesOf(const PlaySettings& settings, bool isSoftwareRenderer);

}  // namespace terrane::app
