#include "apps/terrane/window/game/play_flow.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <utility>

#include "apps/terrane/window/game/game_state.h"
#include "apps/terrane/window/game/watch.h"
#include "apps/terrane/window/settings/settings_table.h"
#include "apps/terrane/window/title/join_dialog.h"
#include "apps/terrane/window/title/join_server.h"
#include "terrane/base/files.h"
#include "terrane/base/log.h"
#include "terrane/content/resource_pack.h"
#include "terrane/game/item_commands.h"
#include "terrane/game/item_keeper.h"
#include "terrane/game/places.h"
#include "terrane/game/spawn.h"
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/io/open_session.h"
#include "terrane/pack/installed_packs.h"
#include "terrane/render/quads/draw_check.h"
#include "terrane/rules/rules.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/store/saves/world_list.h"

namespace terrane::app {

base::Result<void> writeKnownEdits(const std::filesystem::path& file, net::RemoteStore& store,
                                   const world::BlockRegistry& blocks, const world::Pose& pose, int reach) {
    const auto edited = TERRANE_TRY(store.editedChunks());
    const world::ChunkPos center = world::chunkOf(pose.position);
    std::string text = fmt::format("center {} {}\n", center.x, center.y);
    for (const world::ChunkPos pos : edited) {
        if (std::abs(pos.x - center.x) > reach || std::abs(pos.y - center.y) > reach) continue;
        for (const world::PlacedBlock& block : net::placedBlocks(pos, store.difference(pos)))
            text += fmt::format("{} {} {} {}\n", block.pos.x, block.pos.y, block.pos.z,
                                blocks.type(block.value.id).name);
    }
    return base::writeFile(file, text);
}

namespace {

// Empty if no variable names a home: bookmarks and screenshots then go to the working directory.
std::filesystem::path dataFolder() {
    return store::dataFolder(store::saveEnvironment()).value_or(std::filesystem::path());
}

PlaySettings settingsOf(const PlayOptions& options, bool isSoftwareRenderer) {
    PlaySettings settings = options.settings;
    settings.preset = options.graphics.choices.preset;
    settings.graphics = render::settingsOf(options.graphics.choices, isSoftwareRenderer);
    settings.view = options.graphics.view;
    settings.resourcePack = options.graphics.resourcePack;
    return settings;
}

// The first pose: a bookmark, the saved pose, or a spawn point.
base::Result<world::Pose> startOf(const PlayOptions& options, const game::BookmarkFiles& files,
                                  const game::SavedPlayer& saved, game::Session& session) {
    if (options.bookmark) {
        auto bookmarks = TERRANE_TRY(game::readBookmarks(files));
        const auto number = static_cast<std::size_t>(*options.bookmark);
        if (number > bookmarks.size()) {
            return base::fail("--bookmark {}: {} has {}", number, files.file.string(), bookmarks.size());
        }
        return bookmarks[number - 1];
    }
    return saved.pose ? *saved.pose : game::findSpawn(session.generator(), session.blocks());
}

// Worlds are saved unless the player chooses otherwise. A world without a name is named after its generator
// and seed, so that the same options open it again.
base::Result<io::OpenedWorld> openWorld(PlayOptions& options) {
    using store::WorldAccess;
    if (options.savesNothing) {
        TERRANE_TRY(checkSaveOptions(options.save));
        return io::openSessionParts(options.world, options.save, WorldAccess::ReadOnly);
    }
    std::string& name = options.save.world;
    if (name.empty())
        name = fmt::format("{}-{}", options.world.effectiveGenerator(), options.world.effectiveSeed());
    auto parts = io::openSessionParts(options.world, options.save, WorldAccess::ReadWrite);
    // Playing without saving does not help against other errors, such as another generator.
    const bool cannotBeWritten = !parts && (parts.error().code == base::ErrorCode::Io ||
                                            parts.error().code == base::ErrorCode::NotFound);
    if (!cannotBeWritten) return parts;
    return base::fail(parts.error().code, "{} (--no-save plays without saving)", parts.error().message);
}

// Only listed worlds have thumbnails: an image beside another file could belong to the user.
std::filesystem::path thumbnailFor(const PlayOptions& options, const std::filesystem::path& folder) {
    const auto file = store::fileOf(store::worldLocation(options.save.world));
    if (options.savesNothing || !file || folder.empty() || file->parent_path() != folder) return {};
    return store::thumbnailOf(*file);
}

}  // namespace

void takeFromWorld(PlaySettings& settings, const game::SavedPlayer& saved, const GivenOptions& given) {
    const auto movement = saved.movement ? movementNamed(*saved.movement) : std::nullopt;
    if (saved.movement && !movement)
        base::logInfo("unknown movement mode in the save: {:?}", *saved.movement);
    if (movement && !given.movement) settings.movement = *movement;
    if (saved.resourcePack && !given.resourcePack) settings.resourcePack = *saved.resourcePack;
}

PlayFlow::PlayFlow(const PlayOptions& options, const GivenOptions& given, Window& window, PlayHost& host)
    : options_(options),
      given_(given),
      window_(window),
      host_(host),
      shaders_(gpu::builtInShaders(options.graphics.shaderRoot)),
      screen_{&shaders_, render::checkedDevice(shaders_), options.graphics.gpuMemory,
              options.graphics.resourcePack, options.backend},
      settings_(settingsOf(options, screen_.device.software)),
      written_(settings_),
      measuresPreset_(!given.graphics && !options.settingsFile.empty()) {}

base::Result<void> PlayFlow::run() {
    base::Result<void> result;
    if (!options_.remote.server.empty()) {
        result = playServer(options_);
    } else if (given_.namesWorld || options_.skipsTitle) {
        result = playWorld(options_);
    } else {
        goesToTitle_ = true;
    }
    while (result && goesToTitle_ && !isOver()) {
        auto chosen = showTitle();
        if (!chosen) result = tl::unexpected(chosen.error());
        if (!chosen || !*chosen) break;
        hasBegun_ = false;
        result = playChosen(**chosen);
        if (result || hasBegun_) continue;
        message_ = result.error().message;  // shown by the title: the world was not opened
        base::logInfo("{}", message_);
        goesToTitle_ = true;
        result = {};
    }
    auto written = keepSettings();
    return result ? written : result;
}

base::Result<void> PlayFlow::playChosen(const TitleChoice& choice) {
    PlayOptions options = options_;
    options.bookmark.reset();
    options.time.reset();
    options.savesNothing = false;
    if (const auto* server = std::get_if<RemoteOptions>(&choice)) {
        options.remote = *server;
        return playServer(options);
    }
    const auto& chosen = std::get<ChosenWorld>(choice);
    options.save = {.world = chosen.file.string(), .storeGenerated = {}};
    options.world = {.seed = {},
                     .seedText = {},
                     .generator = chosen.generator,
                     .content = options.world.content,
                     .heights = chosen.heights,
                     .threads = options.world.threads};
    options.mode = chosen.mode;
    // A generator PACK:NAME needs its pack.
    if (chosen.generator && chosen.generator->find(':') != std::string::npos)
        options.world.content.push_back(chosen.generator->substr(0, chosen.generator->find(':')));
    if (chosen.seed) options.world.seed = chosen.seed->seed;
    if (chosen.seed) options.world.seedText = chosen.seed->text;
    return playWorld(options);
}

base::Result<std::optional<TitleChoice>> PlayFlow::showTitle() {
    const auto content = TERRANE_TRY(io::loadInstalledContent(options_.world));
    TitleScreen title({window_, signals_, options_, screen_, content, dataFolder()}, settings_,
                      std::exchange(message_, {}));
    auto chosen = title.run();
    TERRANE_TRY(keepSettings());
    return chosen;
}

base::Result<void> PlayFlow::keepSettings() {
    const bool isSoftware = screen_.device.software;
    auto done = writeChanges(options_.settingsFile, valuesOf(written_, isSoftware),
                             valuesOf(settings_, isSoftware), render::namesOfPreset());
    if (done) written_ = settings_;
    return done;
}

base::Result<void> PlayFlow::playWorld(const PlayOptions& asked) {
    PlayOptions options = asked;
    goesToTitle_ = false;
    options.save.followsGenerator = options.watches;
    auto played = playOnce(options);
    while (played && std::exchange(reloads_, false)) {
        options.save.regenerate = store::Regenerate::None;
        options.bookmark.reset();
        options.time.reset();
        played = playOnce(options);
    }
    return played;
}

base::Result<void> PlayFlow::playOnce(PlayOptions& options) {
    contentReadAt_ = std::filesystem::file_time_type::clock::now();
    auto world = TERRANE_TRY(openWorld(options));
    const game::SessionParts& parts = world.parts;
    if (const auto mode = game::modeNamed(options.mode)) game::saveMode(*parts.store, *mode);
    PlaySettings settings = settings_;
    // The world's own, or those of the command line.
    settings.movement = options_.settings.movement;
    settings.resourcePack = options_.graphics.resourcePack;
    takeFromWorld(settings, game::loadPlayer(*parts.store), given_);
    if (settings.resourcePack != options_.graphics.resourcePack) {
        const auto textures =
            content::loadTextures(settings.resourcePack, *parts.blocks, world.content.textures);
        if (!textures) {
            base::logInfo("{}; the world is shown without it", textures.error().message);
            settings.resourcePack.clear();
        }
    }
    settings_ = settings;
    ScreenOptions screen = screen_;
    screen.resourcePack = settings.resourcePack;
    return playFrom(options, std::move(world), std::move(screen));
}

base::Result<void> PlayFlow::playServer(const PlayOptions& asked) {
    PlayOptions options = asked;
    goesToTitle_ = false;
    auto play = TERRANE_TRY(joinServer(window_, signals_, settings_.language, options.remote, dataFolder()));
    if (!play) {
        goesToTitle_ = options_.remote.server.empty();
        return {};
    }
    if (auto kept = rememberServer(serverListFile(dataFolder()), {play->address(), options.remote.name});
        !kept)
        base::logInfo("the server is not remembered: {}", kept.error().message);
    const pack::Content& content = play->content();
    const store::WorldIdentity& identity = play->offer()->world.identity;
    auto parts = TERRANE_TRY(net::remoteSessionParts(identity, content.blocks, io::threadCount(options.world),
                                                     content.generators));
    options.world.seed = identity.seed;
    options.world.generator = identity.generator;
    settings_.movement = options_.settings.movement;
    return playFrom(options, {content, std::move(parts.parts)}, screen_, {std::move(play), parts.store});
}

base::Result<void> PlayFlow::playFrom(const PlayOptions& options, io::OpenedWorld opened,
                                      ScreenOptions screen, ServersWorld given) {
    auto made = TERRANE_TRY(WorldOnScreen::create(std::move(opened), screen));
    WorldOnScreen& world = *made;
    game::Session& session = world.session();
    // Declared after the world: destroyed before the session, which it updates.
    const std::unique_ptr<RemotePlay> remote = std::move(given.play);
    GameOptions game;
    game.dataFolder = dataFolder();
    const game::SavedPlayer saved = game::loadPlayer(session.store());
    const game::BookmarkFiles bookmarks = game::bookmarkFiles(game.dataFolder);
    game::reportLegacyFiles(bookmarks);
    auto start =
        remote ? base::Result<world::Pose>(remote->start()) : startOf(options, bookmarks, saved, session);
    if (!start) return tl::unexpected(start.error());
    session.clock.timeDay = options.time ? *options.time : saved.timeDay.value_or(session.clock.timeDay);
    game.hotbar = saved.hotbar.value_or("");
    game.settings = settings_;
    game.start = *start;
    game.perfData = options.perfData;
    game.isSoftwareRenderer = screen.device.software;
    game.deviceName = screen.device.renderer;
    game.measuresPreset = std::exchange(measuresPreset_, false);
    game.thumbnail = thumbnailFor(options, game.dataFolder);
    ContentWatch watch(*world.content().packs, contentReadAt_);
    if (options.watches && !remote) {
        game.contentChanged = [&] { return watch.hasChanged(std::chrono::steady_clock::now()); };
        game.checkContent = [&]() -> base::Result<void> {
            const auto content = TERRANE_TRY(pack::reloadPacks(world.content()));
            const store::WorldIdentity& identity = session.store().identity();
            const auto graph = gen::makeGenerator(identity.generator, *content.blocks, {0, identity.heights},
                                                  content.generators);
            if (!graph) return tl::unexpected(graph.error());
            return rules::checkScripts(content);
        };
    }
    hasBegun_ = true;
    if (remote) remote->begin(session, *given.store);
    GameState state({window_, world.content(), session, world.renderer(), world.view(), world.preview(),
                     world.compiler(), shaders_, signals_, remote.get()},
                    game);
    std::optional<game::ItemKeeper> items;
    std::optional<game::ItemCommands> itemCommands;
    if (!remote) items.emplace(session);
    // A server runs the rules of its world itself.
    const rules::Rules rules(session, remote ? std::vector<pack::Pack>() : *world.content().packs);
    if (!remote) itemCommands.emplace(session, [](game::PlayerId) { return true; });
    session.events.joined.notify(
        {game::kLocalPlayer, options.remote.name.empty() ? "Player" : options.remote.name});
    host_.game = &state;
    auto played = runGame(state);
    host_.game = nullptr;
    session.events.left.notify({game::kLocalPlayer});
    if (played && remote && !options.knownEdits.empty())
        played = writeKnownEdits(options.knownEdits, *given.store, session.blocks(), state.player.pose(),
                                 state.settings.graphics.viewDistance);
    settings_ = state.settings;
    goesToTitle_ = state.leaving.toTitle && !isOver();
    reloads_ = state.leaving.forReload && !isOver();
    message_ = state.remote.endReason;
    return played;
}

}  // namespace terrane::app
