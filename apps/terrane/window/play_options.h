// What `terrane play` was asked for.
#pragma once

#include <optional>
#include <string>

#include "apps/terrane/back_ends.h"
#include "apps/terrane/graphics_options.h"
#include "apps/terrane/option_values.h"
#include "apps/terrane/window/play_settings.h"
#include "apps/terrane/window/remote_play.h"

namespace terrane::app {

struct PlayOptions {
    WorldOptions world;
    SaveOptions save;
    bool savesNothing = false;
    bool skipsTitle = false;
    bool watches = false;  // content packs: what changes there is shown at once
    GraphicsOptions graphics;
    Backend backend = Backend::Auto;
    PlaySettings settings;
    std::optional<int> bookmark;
    std::optional<double> time;
    RemoteOptions remote;
    std::string knownEdits;  // file that gets what is known of a server's edits at the end; empty: none
    std::string perfData;
    std::string settingsFile = settingsPath().string();
};

// What the command line itself says, rather than the file of settings.
struct GivenOptions {
    bool namesWorld = false;  // which world, or where in it: nobody asks again
    bool movement = false;
    bool resourcePack = false;
    bool graphics = false;  // or the settings
};

}  // namespace terrane::app
