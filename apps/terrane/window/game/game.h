// The window's loop: input, simulation and image of one game (game_state.h).
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "apps/terrane/window/game/remote_play.h"
#include "apps/terrane/window/settings/play_settings.h"
#include "apps/terrane/window/window.h"
#include "terrane/base/process.h"
#include "terrane/render/frame/background_compiler.h"
#include "terrane/view/block_preview.h"
#include "terrane/view/world_view.h"

namespace terrane::app {

// The objects that the loop works with; all outlive it.
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
    RemotePlay* remote = nullptr;  // connection to the world's server; null: none
};

struct GameOptions {
    PlaySettings settings;
    world::Pose start;
    std::string hotbar;                // from game::textOf(); any text is accepted
    std::filesystem::path dataFolder;  // for bookmarks and screenshots
    bool isSoftwareRenderer = false;
    std::string deviceName;                            // of the graphics driver
    bool measuresPreset = false;                       // measure frames and choose a preset
    std::string perfData;                              // file; empty: none
    std::filesystem::path thumbnail;                   // file of the world's thumbnail; empty: none
    std::function<bool()> contentChanged;              // packs changed on disk; may be empty
    std::function<base::Result<void>()> checkContent;  // fails if they cannot be loaded
};

struct GameState;  // game_state.h

// Runs until the player leaves, the window closes, a signal asks to stop or a frame fails; then saves
// everything. If saving fails, the player is asked first; the error names what is lost.
base::Result<void> runGame(GameState& game);

}  // namespace terrane::app
