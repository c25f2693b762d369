// terrane play: opens a window to walk, fly and build in.
#include <algorithm>
#include <memory>

#include "apps/terrane/commands/commands.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "apps/terrane/window/error_window.h"
#include "apps/terrane/window/game/play_flow.h"
#include "apps/terrane/window/glfw_window.h"
#include "apps/terrane/window/settings/key_help.h"
#include "apps/terrane/window/settings/settings_table.h"
#include "apps/terrane/window/text.h"

namespace terrane::app {
namespace {

constexpr const char* kWhereSaved =
    R"(
Without an option that names a world, the title opens. The program saves the world during play, with position,
time of day, hotbar, named places and movement mode, in $XDG_DATA_HOME/terrane/NAME.sqlite
($HOME/.local/share/terrane if that is not set); bookmarks.txt and screenshots/ are beside it. Ctrl+C in the
terminal also saves and quits.)";

base::Result<std::unique_ptr<Window>> openWindow(const PlayOptions& options, const PlayHost& host) {
    const std::filesystem::path settings = options.settingsFile;
    auto window = host.openWindow(
        {.title = "Terrane",
         .width = options.graphics.size.x,
         .height = options.graphics.size.y,
         .fullScreen = options.settings.fullScreen,
         .padMappings = settings.empty() ? "" : settings.parent_path() / "gamecontrollerdb.txt",
         .debug = options.graphics.debugGl});
    if (window) setTerraneIcon(**window);
    return window;
}

bool isGiven(const CLI::App& command, std::string_view name) {
    return command.get_option("--" + std::string(name))->count() > 0;
}

// True if options name a world or a task in it: the title is then skipped.
bool namesWorld(const CLI::App& command) {
    constexpr std::string_view kNames[] = {
        "world",   "seed", "generator",       "recreate",          "watch", "regenerate", "bookmark",
        "no-save", "time", "store-generated", "collect-perf-data", "mode"};
    return std::ranges::any_of(kNames, [&](std::string_view name) { return isGiven(command, name); });
}

// True if the command line or the settings choose graphics: no preset is then measured.
bool namesGraphics(const CLI::App& command) {
    return isGiven(command, "preset") || isGiven(command, "view-distance") ||
           std::ranges::any_of(render::graphicsTable(),
                               [&](const render::GraphicsRow& row) { return isGiven(command, row.name); });
}

base::Result<void> play(const PlayOptions& options, CLI::App& command, PlayHost& host) {
    GivenOptions given{.namesWorld = namesWorld(command),
                       .movement = isGiven(command, "movement"),
                       .resourcePack = isGiven(command, "resource-pack")};
    TERRANE_TRY(applySettings(options.settingsFile, command, render::namesOfPreset()));
    given.graphics = namesGraphics(command);
    // The window first: if it cannot open, no world is created.
    const auto window = TERRANE_TRY(openWindow(options, host));
    TERRANE_TRY(PlayFlow(options, given, *window, host).run());
    const gpu::DebugLog* log = window->debugLog();
    if (log && log->errorCount() > 0) return base::fail("the graphics driver reported errors, see above");
    return {};
}

// Without a display the error is only in standard error.
void showPlayError(const PlayHost& host, const std::string& language, const std::string& error) {
    if (host.isStandardErrorRead()) return;
    const auto window = host.openWindow(errorWindowOptions());
    if (!window) return;
    setTerraneIcon(**window);
    showError(**window, error, textsOf(language));
}

}  // namespace

CommandEntry addPlay(CLI::App& app) {
    return addPlay(app, std::make_shared<PlayHost>());
}

CommandEntry addPlay(CLI::App& app, std::shared_ptr<PlayHost> host) {
    auto options = std::make_shared<PlayOptions>();
    CLI::App* command = app.add_subcommand("play", "Open a window to walk, fly and build in (the default)");
    addWorldOptions(*command, options->world);
    addSaveGameOptions(*command, options->save);
    command->get_option("--world")->description(
        "World to play in; created if needed (default: GENERATOR-SEED)");
    command->add_flag("--no-title", options->skipsTitle, "Skip the title");
    command->add_flag("--no-save", options->savesNothing, "Save nothing: changes are lost at the end");
    addModeOption(*command, options->mode);
    auto* watch =
        command->add_flag("--watch", options->watches,
                          "Reload the content packs of the world when their files change; edits stay");
    watch->excludes("--no-save");
    command->add_option("--connect", options->remote.server, "Play in the world of a server")
        ->type_name("HOST[:PORT]");
    command->add_option("--name", options->remote.name, "Name of the player on the server")
        ->type_name("NAME");
    command->add_option("--password", options->remote.password, "Password of the server, if it has one")
        ->type_name("TEXT");
    command->add_flag("--accept-packs", options->remote.acceptsPacks,
                      "Let the server send content packs without asking");
    // For tools/soak.py; hidden from the help.
    command->add_option("--known-edits", options->knownEdits, "")->group("");
    command->add_option("--bookmark", options->bookmark, "Start at this bookmark, counted from 1")
        ->check(numberFrom(1, 1e6))
        ->type_name("NUMBER");
    command->add_option("--time", options->time, "Time of day: 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk")
        ->check(numberFrom(0, 1));
    writesFile(command->add_option("--collect-perf-data", options->perfData,
                                   "Write statistics of each frame (CSV)"));
    addSettings(*command, options->settings);
    addBackendOption(*command, options->backend, "Device that generates, lights and meshes");
    addGraphicsOptions(*command, options->graphics, "auto");
    command
        ->add_option("--settings", options->settingsFile,
                     "File of settings that the panel writes; \"\": none")
        ->type_name("FILE")
        ->configurable(false);
    command->footer("Keys:\n" + keyHelpText() + kWhereSaved);
    command->get_option("--name")->needs("--connect");
    command->get_option("--accept-packs")->needs("--connect");
    command->get_option("--connect")
        ->needs("--name")
        ->excludes("--world", "--seed", "--generator", "--watch", "--mode");
    CommandEntry entry{command, [options, command, host] { return play(*options, *command, *host); }};
    entry.showError = [options, host](const std::string& error) {
        showPlayError(*host, options->settings.language, error);
    };
    return entry;
}

}  // namespace terrane::app
