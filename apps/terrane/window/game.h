// The window's loop: what a player does, what time does, and the image of it. Everything that is more than
// putting these together lies in the files beside this one.
#pragma once

#include <string>

#include "apps/terrane/window/building_tools.h"
#include "apps/terrane/window/game_sounds.h"
#include "apps/terrane/window/hud.h"
#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/pad_reader.h"
#include "apps/terrane/window/pause_menu.h"
#include "apps/terrane/window/perf_log.h"
#include "apps/terrane/window/place_overlay.h"
#include "apps/terrane/window/play_settings.h"
#include "apps/terrane/window/preset_measurement.h"
#include "apps/terrane/window/remote_play.h"
#include "apps/terrane/window/save_notice.h"
#include "apps/terrane/window/settings_dialog.h"
#include "apps/terrane/window/text.h"
#include "apps/terrane/window/window.h"
#include "terrane/base/stop_signals.h"
#include "terrane/base/timed_value.h"
#include "terrane/game/block_interaction.h"
#include "terrane/game/bookmarks.h"
#include "terrane/game/day_clock.h"
#include "terrane/game/player_state.h"
#include "terrane/render/background_compiler.h"
#include "terrane/view/block_preview.h"
#include "terrane/view/frame_meter.h"
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

class Game {
  public:
    static constexpr double kMemoryPause = 0.5;     // seconds for which statistics of memory stay as they are
    static constexpr double kShaderPause = 1;       // seconds between looks at the files of shaders
    static constexpr double kThumbnailPause = 180;  // seconds between pictures of the world

    Game(const GameParts& parts, const GameOptions& options);

    // Until the player leaves, the window closes, a signal asks to stop or a frame fails; then everything is
    // saved. Where that fails the player is asked first; an error says what is lost.
    base::Result<void> run();
    // After run(): the player wants the title, not to quit.
    bool goesToTitle() const { return goesToTitle_; }
    // The content changed: the world is to be opened again.
    bool wantsReload() const { return wantsReload_; }
    const PlaySettings& settings() const { return settings_; }
    world::Pose pose() const { return player_.pose(); }
    // Why the server sent the player away; empty where it did not.
    const std::string& serverReason() const { return serverReason_; }

  private:
    using WriteTime = std::optional<std::filesystem::file_time_type>;

    void handleEvents();
    void onKey(Key key);
    void act(Action action);
    void leave(bool toTitle);
    void onPad(double seconds);
    void onButton(MouseButton button, bool isPress);
    bool useTarget();
    bool openContainer();
    void closeContainer();
    BuildView buildView() const;
    bool openSign();
    void drawBuilding(const Screen& screen);
    void capture(bool isCaptured);
    void closeOne();
    void pause();
    void resume();
    void answerPauseMenu(PauseChoice choice);
    bool isInMenu() const { return isPaused_ || asksToQuit_; }
    // Keys move nobody, and clicks take no mouse.
    bool isInDialog() const { return isInMenu() || container_ || hud_.hasDialog() || building_.isAsking(); }
    bool onControlKey(Key key);
    void openPalette();
    void openPlaces();
    void takeBack(game::HistoryWay way);
    void tellTakenBack(const game::TakenBack& done, bool isUndo);
    void tellRefusal(game::EditResult result);
    void goToSpawn();
    void breakAndBuild(double seconds);
    void advanceHud(double seconds);
    void drawHud(const Screen& screen, const render::Camera& camera, double seconds);
    void drawPaletteDialog(const Screen& screen);
    void drawPlacesDialog(const Screen& screen);
    BlockFace blockFace();
    glm::vec3 lightOnHand() const;
    std::string targetText() const;
    PlaceFacts placeFacts();
    void saveBookmark();
    void nextBookmark();
    void takeScreenshot();
    void nextMovement();
    void nextLight();
    void say(std::string message);
    void writeThumbnail();

    game::MoveKeys moveKeys() const;
    render::Camera camera() const;
    base::Result<void> drawFrames();
    void advance(double seconds);
    void advanceRemote();
    void tellDecided(const net::Decided& decided);
    void drawRemote(const Screen& screen, const render::Camera& camera);
    void beginChat();
    void liftFromBelow();
    void applySettings();
    base::Result<void> useResourcePack(const std::string& folder);
    void reloadWrittenShaders();
    void reloadContent();
    bool hasWorldImage() const { return parts_.renderer.size().x > 0; }
    const render::RenderOptions& renderOptions() const;
    void beginMeasurement();
    void endMeasurement();
    void measurePreset(double seconds);
    void sayPreset();
    bool shadersAreReady(glm::ivec2 size);
    base::Result<void> configureRenderer(glm::ivec2 size);
    base::Result<void> drawFrame(double seconds);
    render::FrameInput frameInput() const;
    void drawInterface(double seconds);
    void drawOpenContainer(const Screen& screen);
    std::optional<glm::vec3> shadowLight() const;
    Statistics statistics();
    MemoryStatistics memoryStatistics() const;
    game::PlayerState playerState() const;
    base::Result<void> save();
    bool staysAfter(const base::Result<void>& saved);
    void answerQuitDialog(QuitChoice choice);

    GameParts parts_;
    PlaySettings settings_, applied_;
    Texts tr_;
    GameSounds sounds_;
    bool isSoftwareRenderer_;
    ImguiLayer imgui_;
    game::Player player_;
    game::BlockInteraction interaction_;
    Hud hud_;
    PadReader pad_;
    view::FrameMeter meter_;
    base::TimedValue<MemoryStatistics> memory_{kMemoryPause};
    base::TimedValue<WriteTime> shadersWritten_{kShaderPause};
    WriteTime shadersRead_;                     // the newest one when they were last read
    std::optional<world::BlockPos> container_;  // the open one
    std::optional<game::PlayerState> saved_;    // as handed to the store
    std::filesystem::path screenshots_;         // folder
    game::BookmarkFiles bookmarks_;
    BuildingTools building_;
    bool wasAsking_ = false;
    bool withShift_ = false, withControl_ = false;  // held with the event that is handled, else now
    std::string perfData_;
    std::function<bool()> contentChanged_;
    std::function<base::Result<void>()> checkContent_;
    std::optional<PerfLog> perfLog_;
    std::optional<PresetMeasurement> measurement_;  // while it goes on
    std::string deviceName_, presetMessage_;
    SettingsDialog settingsDialog_;
    std::filesystem::path thumbnail_;
    double untilThumbnail_ = kThumbnailPause;

    bool isCaptured_ = false, showsPanel_ = false, isAbove_ = false, showsLoading_ = false;
    bool isPaused_ = false, asksToQuit_ = false, quitsUnsaved_ = false, showsSettings_ = false;
    bool isLeaving_ = false, goesToTitle_ = false, wantsReload_ = false;
    bool wasComplete_ = false;  // all in view has been there once
    double hintSeconds_ = 12, messageSeconds_ = 0;
    std::string message_, serverReason_;
    net::ClientLink::Stage linkStage_ = net::ClientLink::Stage::Joined;
    std::size_t nextBookmark_ = 0, frames_ = 0;
    double seconds_ = 0;   // since the start
    double nextList_ = 0;  // of players, in `seconds_`
};

}  // namespace terrane::app
