// Options of `terrane play`.
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
