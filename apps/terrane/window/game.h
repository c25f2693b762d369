// The window's loop: what a player does, what time does, and the image of it (game_state.h).
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "apps/terrane/window/play_settings.h"
#include "apps/terrane/window/remote_play.h"
#include "apps/terrane/window/window.h"
#include "terrane/base/stop_signals.h"
#include "terrane/render/background_compiler.h"
#include "terrane/view/block_preview.h"
#include "terrane/view/world_view.h"

namespace terrane::app {

// What the loop works with; everything outlives it.
struct GameParts {
    Window& window;
    const pack::Content& content;
    game::Session& session;
    render::Renderer& renderer;
    view::WorldView& view;
    view::BlockPreview& preview;
    render::BackgroundCompiler& compiler;
    const gpu::ShaderLoader& shaders;
    const base::StopSignals& signals;
    RemotePlay* remote = nullptr;  // the server whose world it is; null: none
};

struct GameOptions {
    PlaySettings settings;
    world::Pose start;
    std::string hotbar;                // as game::textOf() says it; any text
    std::filesystem::path dataFolder;  // for bookmarks and screenshots
    bool isSoftwareRenderer = false;
    std::string deviceName;                            // of the graphics driver
    bool measuresPreset = false;                       // the settings get the preset that a measurement picks
    std::string perfData;                              // file; empty: none
    std::filesystem::path thumbnail;                   // file of the world's picture; empty: none
    std::function<bool()> contentChanged;              // whether packs on the disk changed; may be empty
    std::function<base::Result<void>()> checkContent;  // what is wrong with them now
};

// What a game was left with.
struct GameEnd {
    PlaySettings settings;
    world::Pose pose;
    bool toTitle = false;      // the player wants the title, not to quit
    bool wantsReload = false;  // the content changed: the world is to be opened again
    std::string serverReason;  // why the server sent the player away; empty where it did not
};

// Until the player leaves, the window closes, a signal asks to stop or a frame fails; then everything is
// saved. Where that fails the player is asked first; an error says what is lost. `end` is filled in any case.
base::Result<void> runGame(const GameParts& parts, const GameOptions& options, GameEnd& end);

}  // namespace terrane::app
