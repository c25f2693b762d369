// The sequence of screens while the program plays: the title, a world, the title again. Used on the thread of
// the OpenGL context.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "apps/terrane/window/error_window.h"
#include "apps/terrane/window/game/world_on_screen.h"
#include "apps/terrane/window/glfw_window.h"
#include "apps/terrane/window/settings/play_settings.h"
#include "apps/terrane/window/title/title_screen.h"
#include "terrane/base/process.h"
#include "terrane/game/player_state.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/net/client/remote_session.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/pose.h"

namespace terrane::app {

// Writes a client's knowledge of a server's world as text: tools/soak.py compares it with the world.
// Covers chunks up to `reach` chunks from that of `pose`: a line "center X Y" with that chunk, then "X Y Z
// NAME" for each block that differs from the generated one. Overwrites `file`.
[[nodiscard]] base::Result<void> writeKnownEdits(const std::filesystem::path& file, net::RemoteStore& store,
                                                 const world::BlockRegistry& blocks, const world::Pose& pose,
                                                 int reach);

// Sets movement and resource pack: from the command line, else from the world's save, else from `settings`.
// An unknown movement in the save is ignored with a line in the log.
void takeFromWorld(PlaySettings& settings, const game::SavedPlayer& saved, const GivenOptions& given);

struct GameState;

// The surroundings of `terrane play`: tests open another window and look at the game.
struct PlayHost {
    std::function<base::Result<std::unique_ptr<Window>>(const WindowOptions&)> openWindow = openGlfwWindow;
    std::function<bool()> isStandardErrorRead = app::isStandardErrorRead;
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
    base::Result<void> playFrom(const PlayOptions& options, io::OpenedWorld opened, ScreenOptions screen,
                                ServersWorld given = {});
    base::Result<std::optional<TitleChoice>> showTitle();
    base::Result<void> keepSettings();
    bool isOver() const { return window_.shouldClose() || signals_.stopRequested(); }

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
