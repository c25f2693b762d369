// terrane play: a window to walk, fly and build in.
#include <algorithm>
#include <memory>

#include "apps/terrane/choose_back_ends.h"
#include "apps/terrane/commands/commands.h"
#include "apps/terrane/open_session.h"
#include "apps/terrane/options.h"
#include "apps/terrane/window/game.h"
#include "apps/terrane/window/icon.h"
#include "apps/terrane/window/key_help.h"
#include "apps/terrane/window/text.h"
#include "terrane/base/log.h"
#include "terrane/base/stop_signals.h"
#include "terrane/content/built_in.h"
#include "terrane/content/resource_pack.h"
#include "terrane/game/bookmarks.h"
#include "terrane/game/player_state.h"
#include "terrane/game/spawn.h"
#include "terrane/gpu/built_in_shaders.h"
#include "terrane/store/save_path.h"
#include "terrane/view/memory_budget.h"

namespace terrane::app {
namespace {

constexpr const char* kWhereSaved =
    R"(

The world, the place, the time of day and the block in the hand are saved while one plays, in
$XDG_DATA_HOME/terrane/NAME.sqlite ($HOME/.local/share/terrane where that is not set); bookmarks.txt and
screenshots/ lie beside it. Ctrl+C in the terminal saves and quits, too.)";

struct PlayOptions {
    WorldOptions world;
    SaveOptions save;
    bool savesNothing = false;
    GraphicsOptions graphics;
    Backend backend = Backend::Auto;
    PlaySettings settings;
    std::optional<int> bookmark;
    std::optional<double> time;
    std::string perfData;
    std::string settingsFile = settingsPath().string();
};

// What the player sees first: a bookmark, where the save was left, or a pleasant place.
base::Result<world::Pose> startOf(const PlayOptions& options, const game::BookmarkFiles& files,
                                  const game::SavedPlayer& saved, game::Session& session) {
    if (options.bookmark) {
        auto bookmarks = game::readBookmarks(files);
        if (!bookmarks) return tl::unexpected(bookmarks.error());
        const auto number = static_cast<std::size_t>(*options.bookmark);
        if (number > bookmarks->size()) {
            return base::fail("--bookmark {}: {} has {}", number, files.file.string(), bookmarks->size());
        }
        return (*bookmarks)[number - 1];
    }
    return saved.pose ? *saved.pose : game::findSpawn(session.generator(), session.blocks());
}

// Worlds are saved unless the player chooses otherwise. One without a name has that of what makes it, so that
// it fits whenever the same is asked for.
base::Result<game::SessionParts> openWorld(PlayOptions& options) {
    using store::WorldAccess;
    if (options.savesNothing) return openSessionParts(options.world, options.save, WorldAccess::ReadOnly);
    std::string& name = options.save.world;
    if (name.empty())
        name = fmt::format("{}-{}", options.world.effectiveGenerator(), options.world.effectiveSeed());
    auto parts = openSessionParts(options.world, options.save, WorldAccess::ReadWrite);
    // Of other errors, such as another generator, playing without saving is no way out.
    const bool cannotBeWritten = !parts && (parts.error().code == base::ErrorCode::Io ||
                                            parts.error().code == base::ErrorCode::NotFound);
    if (!cannotBeWritten) return parts;
    return base::fail(parts.error().code, "{} (--no-save plays without saving)", parts.error().message);
}

// Empty where no variable names a home: bookmarks and screenshots are then kept in the working directory.
std::filesystem::path dataFolder() {
    return store::dataFolder(store::savePlaces()).value_or(std::filesystem::path());
}

base::Result<Window> openWindow(const PlayOptions& options) {
    auto window = Window::create({.title = "Terrane",
                                  .width = options.graphics.size.x,
                                  .height = options.graphics.size.y,
                                  .fullScreen = options.settings.fullScreen,
                                  .debug = options.graphics.debugGl});
    if (window) setTerraneIcon(*window);
    return window;
}

PlaySettings settingsOf(const PlayOptions& options, bool isSoftwareRenderer) {
    PlaySettings settings = options.settings;
    settings.preset = options.graphics.choices.preset;
    settings.graphics = render::settingsOf(options.graphics.choices, isSoftwareRenderer);
    settings.view = options.graphics.view;
    settings.resourcePack = options.graphics.resourcePack;
    return settings;
}

// Neither the command line nor the settings say anything about graphics. Without a file of settings nothing
// is measured, as it would be again at each start.
bool isFirstStart(const PlayOptions& options, const CLI::App& command) {
    const auto isGiven = [&](std::string_view name) {
        return command.get_option("--" + std::string(name))->count() > 0;
    };
    return !options.settingsFile.empty() && !isGiven("preset") && !isGiven("view-distance") &&
           std::ranges::none_of(render::graphicsTable(), isGiven, &render::GraphicsRow::name);
}

base::Result<void> play(PlayOptions& options, CLI::App& command) {
    if (auto read = applySettings(options.settingsFile, command, render::namesOfPreset()); !read) return read;
    // The window first: without one no world is made.
    auto window = openWindow(options);
    if (!window) return tl::unexpected(window.error());
    auto parts = openWorld(options);
    if (!parts) return tl::unexpected(parts.error());
    auto textures = content::loadTextures(options.graphics.resourcePack, *parts->blocks);
    if (!textures) return tl::unexpected(textures.error());
    const gpu::ShaderLoader shaders = gpu::builtInShaders(options.graphics.shaderRoot);
    const gpu::DeviceInfo device = gpu::queryDevice();
    auto renderer = render::Renderer::create(shaders, *parts->blocks, *textures, device);
    if (!renderer) return tl::unexpected(renderer.error());
    renderer->setMemoryBudget(view::gpuMemoryBudget(device, options.graphics.gpuMemory));
    auto preview = view::BlockPreview::create(shaders, *parts->blocks, *textures, device);
    if (!preview) return tl::unexpected(preview.error());
    const auto backEnds = chooseBackEnds(*parts, options.world, options.backend);
    if (!backEnds) return tl::unexpected(backEnds.error());
    game::Session session(std::move(*parts));
    render::BackgroundCompiler compiler(shaders, session.blocks(), content::builtInTextures());
    GameOptions game;
    game.dataFolder = dataFolder();
    const game::SavedPlayer saved = game::savedPlayer(session.store());
    const game::BookmarkFiles bookmarks = game::bookmarkFiles(game.dataFolder);
    game::reportFormerFiles(bookmarks);
    auto start = startOf(options, bookmarks, saved, session);
    if (!start) return tl::unexpected(start.error());
    session.clock.timeDay = options.time ? *options.time : saved.timeDay.value_or(session.clock.timeDay);

    game.hand = saved.hand.value_or("");
    game.settings = settingsOf(options, device.software);
    game.start = *start;
    game.perfData = options.perfData;
    game.isSoftwareRenderer = device.software;
    game.deviceName = device.renderer;
    game.measuresPreset = isFirstStart(options, command);
    view::WorldView view(session, *renderer);
    if (*backEnds) {
        const auto meshes = view.meshOnGpu(gpu::builtInShaders(""), view::WorldView::kFrameMilliseconds);
        if (!meshes) return meshes;
    }
    const base::StopSignals signals;
    Game loop({*window, session, *renderer, view, *preview, compiler, shaders, signals}, game);
    const auto played = loop.run();
    auto written = writeChanges(options.settingsFile, valuesOf(game.settings, device.software),
                                valuesOf(loop.settings(), device.software), render::namesOfPreset());
    if (!played) return played;
    if (!written) return written;
    if (window->debugLog() && window->debugLog()->errorCount() > 0) {
        return base::fail("the graphics driver reported errors, see above");
    }
    return {};
}

void addPlaySettings(CLI::App& command, PlaySettings& settings) {
    addChoice<game::Movement>(command, "--movement", settings.movement,
                              {movementNames().begin(), movementNames().end()}, "How one moves");
    command.add_option("--field-of-view", settings.fieldOfView, "Degrees, from below to above")
        ->check(numberFrom(40, 110))
        ->capture_default_str();
    command.add_option("--mouse-sensitivity", settings.mouseSensitivity, "Degrees a step of the mouse")
        ->check(numberFrom(0.02, 0.6))
        ->capture_default_str();
    command.add_option("--sound-volume", settings.soundVolume, "How loud sounds are, 0 (none) to 1")
        ->check(numberFrom(0, 1))
        ->capture_default_str();
    command.add_option("--day-minutes", settings.dayMinutes, "How long a day takes")
        ->check(numberFrom(0.5, 1440))
        ->capture_default_str();
    addChoice<std::string>(command, "--language", settings.language, languageChoices(),
                           "Language of names and menus; auto: that of the system");
    command.add_flag("--full-screen", settings.fullScreen, "Take the whole screen");
}

}  // namespace

CommandEntry addPlay(CLI::App& app) {
    auto options = std::make_shared<PlayOptions>();
    CLI::App* command = app.add_subcommand("play", "Open a window to walk, fly and build in (the default)");
    addWorldOptions(*command, options->world);
    addSaveGameOptions(*command, options->save);
    command->get_option("--world")->description(
        "World to play in; created if needed (default: GENERATOR-SEED)");
    command->add_flag("--no-save", options->savesNothing, "Save nothing: changes are lost at the end");
    command->add_option("--bookmark", options->bookmark, "Start at this bookmark, counted from 1")
        ->check(numberFrom(1, 1e6))
        ->type_name("X");
    command->add_option("--time", options->time, "Time of day: 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk")
        ->check(numberFrom(0, 1));
    command->add_option("--collect-perf-data", options->perfData, "Write statistics of each frame (CSV)")
        ->type_name("FILE");
    addPlaySettings(*command, options->settings);
    addBackendOption(*command, options->backend, "Where to generate, light and mesh");
    addGraphicsOptions(*command, options->graphics, "auto");
    command
        ->add_option("--settings", options->settingsFile,
                     "File of settings that the panel writes; \"\": none")
        ->type_name("FILE");
    command->footer(std::string("Keys:\n") + kKeyHelp + kWhereSaved);
    return {command, [options, command] { return play(*options, *command); }};
}

}  // namespace terrane::app
