// All that the window's loop holds from frame to frame, by subject. What is done with it lies in free
// functions, a file for each subject: game_input.h, game_actions.h, game_menu.h, game_image.h, game_hud.h,
// game_interface.h, game_statistics.h. They hand on to others only what those need.
#pragma once

#include <filesystem>
#include <optional>

#include "apps/terrane/window/building_tools.h"
#include "apps/terrane/window/game.h"
#include "apps/terrane/window/game_sounds.h"
#include "apps/terrane/window/hud.h"
#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/notices.h"
#include "apps/terrane/window/pad_reader.h"
#include "apps/terrane/window/perf_log.h"
#include "apps/terrane/window/preset_picker.h"
#include "apps/terrane/window/remote_view.h"
#include "apps/terrane/window/settings_dialog.h"
#include "apps/terrane/window/shader_watch.h"
#include "terrane/base/timed_value.h"
#include "terrane/game/block_interaction.h"
#include "terrane/game/bookmarks.h"
#include "terrane/game/player_state.h"
#include "terrane/view/frame_meter.h"

namespace terrane::app {

// Keys, buttons and the gamepad.
struct GameInput {
    bool isCaptured = false;                      // the mouse turns the player, and the cursor is hidden
    bool withShift = false, withControl = false;  // held with the event that is handled, else now
    PadReader pad;
};

// The menu over the game, and what it asks.
struct GameMenu {
    SettingsDialog settings;
    bool isPaused = false, showsSettings = false;
    bool asksToQuit = false;    // saving failed
    bool quitsUnsaved = false;  // and the player wants to go all the same
};

// What is shown for who wants to know how things work.
struct DebugViews {
    bool showsPanel = false, showsLoading = false;
    bool isAbove = false;  // the camera, with what it sees drawn as lines
};

// Whether the loop ends, and where to.
struct Leaving {
    bool isAsked = false;
    bool toTitle = false, forReload = false;
};

constexpr double kThumbnailPause = 180;  // seconds between pictures of the world
constexpr double kMemoryPause = 0.5;     // seconds for which statistics of memory stay as they are

struct GameState {
    GameState(const GameParts& parts, const GameOptions& options);

    GameParts parts;
    GameOptions options;
    PlaySettings settings, applied;  // as they are to be; as the frame before had them
    Texts tr;
    double seconds = 0;      // since the start
    std::size_t frames = 0;  // drawn

    game::Player player;
    game::BlockInteraction interaction;
    std::optional<game::PlayerState> saved;    // as handed to the store
    std::optional<world::BlockPos> container;  // the open one
    game::BookmarkFiles bookmarks;
    std::size_t nextBookmark = 0;

    GameInput input;
    GameMenu menu;
    DebugViews debug;
    Leaving leaving;

    ImguiLayer imgui;
    Hud hud;
    Notices notices;
    BuildingTools building;
    bool wasAsking = false;    // the tools, in the frame before
    bool wasComplete = false;  // all in view has been there once
    RemoteView remote;
    GameSounds sounds;

    PresetPicker preset;
    ShaderWatch shaders;
    double untilThumbnail = kThumbnailPause;  // seconds
    view::FrameMeter meter;
    base::TimedValue<MemoryStatistics> memory{kMemoryPause};
    std::optional<PerfLog> perfLog;
};

bool isInMenu(const GameState& game);       // the game stands still
bool hasOpenDialog(const GameState& game);  // of blocks, places or chat
// Keys move nobody, and clicks take no mouse.
bool isInDialog(const GameState& game);

render::Camera cameraOf(const GameState& game);
bool hasWorldImage(const GameState& game);  // false until the first shaders are compiled
BuildView buildViewOf(const GameState& game);

}  // namespace terrane::app
