// Settings that a user can change while playing. settings_table.h has a row for each.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/graphics_options.h"
#include "apps/terrane/options.h"
#include "apps/terrane/settings.h"
#include "apps/terrane/window/game/remote_play.h"
#include "apps/terrane/window/settings/key_bindings.h"
#include "apps/terrane/window/window.h"
#include "terrane/game/player.h"
#include "terrane/mesh/mesh_options.h"
#include "terrane/render/frame/frame_uniforms.h"
#include "terrane/render/frame/graphics_table.h"

namespace terrane::app {

struct PlaySettings {
    std::string preset = "auto";
    render::GraphicsSettings graphics;  // of the preset, with changes
    render::View view = render::View::Color;
    game::Movement movement = game::Movement::Walk;
    float fieldOfView = 70;  // degrees
    // Frames a second that the render scale holds: 0 none, kAutomaticRate the monitor's, or 30 in software.
    static constexpr int kAutomaticRate = -1;
    int targetFps = kAutomaticRate;
    double frameLimit = 0;  // frames a second; 0: none
    Vsync vsync = Vsync::On;
    float mouseSensitivity = 0.15f;  // degrees per screen unit
    double dayMinutes = 20;
    bool fullScreen = false;
    float soundVolume = 0.6f;       // 0: none
    std::string resourcePack;       // folder; empty: none
    std::string language = "auto";  // of --language (text.h)

    KeyBindings keys;
    PadBindings padButtons;
    bool invertY = false;  // pushing the mouse or stick forward looks down
    bool autoJump = false;
    float textSize = 1;         // scale of the user interface
    bool highContrast = false;  // of the outline of the targeted block
    bool reducedMotion = false;
    bool hintSeen = false;  // the hint of the first start was shown

    bool operator==(const PlaySettings&) const = default;
};

EnumNames<game::Movement> movementNames();  // of the option --movement
const std::string& nameOf(game::Movement movement);
std::optional<game::Movement> movementNamed(std::string_view name);  // also by its former name

// Options of `terrane play`.
struct PlayOptions {
    io::WorldOptions world;
    io::SaveOptions save;
    bool savesNothing = false;
    bool skipsTitle = false;
    std::string mode;      // of the world, by game::kModeNames; empty: its own
    bool watches = false;  // reload content packs that change
    GraphicsOptions graphics;
    Backend backend = Backend::Auto;
    PlaySettings settings;
    std::optional<int> bookmark;
    std::optional<double> time;
    RemoteOptions remote;
    std::string knownEdits;  // file for the known edits of a server at the end; empty: none
    std::string perfData;
    std::string settingsFile = settingsPath().string();
};

// Which options the command line itself sets, rather than the settings file.
struct GivenOptions {
    bool namesWorld = false;  // the world or a place in it: skips the title
    bool movement = false;
    bool resourcePack = false;
    bool graphics = false;  // by the command line or the settings
};

}  // namespace terrane::app
