// The sequence of screens while the program plays: the title, a world, the title again. Used on the thread of
// the OpenGL context.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "apps/terrane/window/glfw_window.h"
#include "apps/terrane/window/play_options.h"
#include "apps/terrane/window/title_screen.h"
#include "apps/terrane/window/world_on_screen.h"
#include "terrane/base/stop_signals.h"
#include "terrane/game/player_state.h"
#include "terrane/gpu/shader_loader.h"

namespace terrane::app {

// Sets movement and resource pack: from the command line, else from the world's save, else from `settings`.
// An unknown movement in the save is ignored with a line in the log.
void takeFromWorld(PlaySettings& settings, const game::SavedPlayer& saved, const GivenOptions& given);

struct GameState;

// The surroundings of `terrane play`: tests open another window and look at the game.
struct PlayHost {
    std::function<base::Result<std::unique_ptr<Window>>(const WindowOptions&)> openWindow = openGlfwWindow;
    GameState* game = nullptr;  // that is played now
};

// A server's world, and the store of the session that shows it; null for a local world.
struct ServersWorld {
    std::unique_ptr<RemotePlay> play;
    net::RemoteStore* store = nullptr;
};

class PlayFlow {
  public:
    // `window` and `host` outlive this.
    PlayFlow(const PlayOptions& options, const GivenOptions& given, Window& window, PlayHost& host);

    base::Result<void> run();

  private:
    // Returns when the player leaves the world; fails if it cannot be opened or saved.
    base::Result<void> playWorld(const PlayOptions& options);
    base::Result<void> playOnce(PlayOptions& options);
    base::Result<void> playServer(const PlayOptions& options);
    base::Result<void> playChosen(const TitleChoice& choice);
    base::Result<void> playFrom(const PlayOptions& options, OpenedWorld opened, ScreenOptions screen,
                                ServersWorld given = {});
    base::Result<std::optional<TitleChoice>> showTitle();
    base::Result<void> keepSettings();
    bool isOver() const { return window_.shouldClose() || signals_.stopAsked(); }

    PlayOptions options_;
    GivenOptions given_;
    Window& window_;
    PlayHost& host_;
    const gpu::ShaderLoader shaders_;
    const base::StopSignals signals_;
    ScreenOptions screen_;
    PlaySettings settings_;
    PlaySettings written_;  // as in the settings file
    bool measuresPreset_, goesToTitle_ = false, hasBegun_ = false, reloads_ = false;
    std::filesystem::file_time_type contentReadAt_;  // begin of reading the packs
    std::string message_;                            // shown by the title
};

}  // namespace terrane::app
