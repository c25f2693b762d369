// The state of the window's loop, by subject. Free functions work on it, in one file per subject:
// game_input.h, game_menu.h, game_image.h, game_interface.h.
// They pass to other code only the parts that it needs.
#pragma once

#include <filesystem>
#include <optional>

#include "apps/terrane/window/game/game.h"
#include "apps/terrane/window/game/game_sounds.h"
#include "apps/terrane/window/game/perf_log.h"
#include "apps/terrane/window/game/remote_view.h"
#include "apps/terrane/window/game/watch.h"
#include "apps/terrane/window/hud/building_tools.h"
#include "apps/terrane/window/hud/hud.h"
#include "apps/terrane/window/hud/notices.h"
#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/input.h"
#include "apps/terrane/window/settings/preset_measurement.h"
#include "apps/terrane/window/settings/settings_dialog.h"
#include "terrane/base/timing.h"
#include "terrane/game/block_interaction.h"
#include "terrane/game/places.h"
#include "terrane/game/player_state.h"
#include "terrane/render/frame/scale_governor.h"
#include "terrane/view/eye.h"
#include "terrane/view/frame_times.h"

namespace terrane::app {

// State of keys, buttons and the gamepad.
struct GameInput {
    bool isCaptured = false;                      // the mouse turns the player, and the cursor is hidden
    bool withShift = false, withControl = false;  // of the handled event, else current
    PadReader pad;
    DoublePress jump;
    // Blocks are broken or placed by a key or gamepad button, which is released once none is down.
    bool breaksByKey = false, placesByKey = false;
    double timeHeldSeconds = 0;  // a key of time is held
    Wheel wheel;
};

// The menu over the game, and its questions.
struct GameMenu {
    SettingsDialog settings;
    bool isPaused = false, showsSettings = false;
    bool asksToQuit = false;    // saving failed
    bool quitsUnsaved = false;  // the player agreed to quit unsaved
};

// Views for developers.
struct DebugViews {
    bool showsPanel = false, showsLoading = false;
    bool isAbove = false;  // debug top view: the camera's frustum as lines
};

// Whether the loop ends, and what follows.
struct Leaving {
    bool isAsked = false;
    bool toTitle = false, forReload = false;
};

constexpr double kThumbnailPause = 180;  // seconds between thumbnails of the world
constexpr double kMemoryPause = 0.5;     // seconds between memory statistics

struct GameState {
    GameState(const GameParts& parts, const GameOptions& options);

    GameParts parts;
    GameOptions options;
    PlaySettings settings, applied;  // current; as of the last frame
    Texts tr;
    double seconds = 0;      // since the start of the game
    std::size_t frames = 0;  // drawn

    game::Player player;
    game::BlockInteraction interaction;
    std::optional<game::PlayerState> saved;    // last passed to the store
    std::optional<world::BlockPos> container;  // that is open
    game::BookmarkFiles bookmarks;
    std::size_t nextBookmark = 0;

    GameInput input;
    GameMenu menu;
    DebugViews debug;
    Leaving leaving;

    ImguiLayer imgui;
    Hud hud;
    ItemImages itemImages;
    Notices notices;
    BuildingTools building;
    bool wasAsking = false;    // building.isAsking() in the last frame
    bool wasComplete = false;  // the view was complete once
    RemoteView remote;
    GameSounds sounds;

    view::Eye eye;
    PresetPicker preset;
    render::ScaleGovernor scale;
    base::TimedValue<double> refreshRate{1};  // of the monitor; a window may move
    Vsync vsync = Vsync::On;                  // of the window
    ShaderWatch shaders;
    double untilThumbnail = kThumbnailPause;  // seconds
    view::FrameMeter meter;
    base::TimedValue<MemoryStatistics> memory{kMemoryPause};
    std::optional<PerfLog> perfLog;
    game::Subscription said;  // lines of the world's rules
};

bool isInMenu(const GameMenu& menu);  // the game is paused
bool hasOpenDialog(const Hud& hud, const ChatView& chat);
bool isInSurvival(const GameState& game);
// Keys do not move the player, and clicks do not capture the mouse.
bool isInDialog(const GameState& game);

render::Camera cameraOf(const game::Player& player, const PlaySettings& settings);
bool hasWorldImage(const render::Renderer& renderer);  // false until the first shaders are compiled
BuildView buildViewOf(const GameState& game);

}  // namespace terrane::app
