#include "apps/terrane/window/game/game.h"

#include <utility>

#include "apps/terrane/window/game/game_image.h"
#include "apps/terrane/window/game/game_input.h"
#include "apps/terrane/window/game/game_interface.h"
#include "apps/terrane/window/game/game_menu.h"
#include "apps/terrane/window/text.h"
#include "terrane/base/log.h"
#include "terrane/game/spawn.h"

namespace terrane::app {
namespace {

void savePlayer(game::Session& session, const game::Player& player, const game::Hotbar& hotbar,
                const PlaySettings& settings, std::optional<game::PlayerState>& saved) {
    game::savePlayer(
        session.store(),
        {.pose = player.pose(),
         .timeDay = session.clock.timeDay,
         .hotbar = game::textOf(hotbar, session.blocks()),
         .movement = nameOf(settings.movement),
         // Absolute, to be found from another working directory.
         .resourcePack =
             settings.resourcePack.empty() ? "" : std::filesystem::absolute(settings.resourcePack).string()},
        saved);
}

base::Result<void> save(game::Session& session) {
    const auto saved = session.save();
    if (saved) return saved;
    return base::fail(saved.error().code, "{}; not saved: {} chunks", saved.error().message,
                      session.store().status().waiting);
}

// Moves a player on foot below the world to the surface, since it would fall forever. Returns whether it did.
bool liftFromBelow(game::Player& player, game::Movement movement, const game::Session& session) {
    if (movement == game::Movement::Noclip) return false;
    const auto lifted = game::poseOnSurface(session.world(), session.blocks(), player.pose());
    if (lifted) player.placeAt(*lifted, movement);
    return lifted.has_value();
}

void advance(GameState& game, double seconds) {
    const GameParts& parts = game.parts;
    game::Session& session = parts.session;
    game.seconds += seconds;
    game.notices.advance(seconds);
    game.untilThumbnail -= seconds;
    if (game.untilThumbnail <= 0) {
        game.untilThumbnail = kThumbnailPause;
        writeThumbnailOf(parts.renderer, game.options.thumbnail);
    }
    if (!game.remote.play) session.clock.dayMinutes = game.settings.dayMinutes;
    handlePad(game, seconds);
    passHeldTime(game, seconds);
    const double gameSeconds = isInMenu(game.menu) ? 0 : seconds;
    game.player.move(session.world(), session.blocks(), moveKeysOf(game), gameSeconds);
    if (liftFromBelow(game.player, game.settings.movement, session))
        game.notices.say(game.tr("you fell out of the world and are back on the ground"));
    session.setPlayer(game::kLocalPlayer, game.player.pose());
    if (game.remote.play) {
        const RemoteStep step = advanceRemote(game.remote, game.player.pose(), game.settings, game.seconds,
                                              game.notices, game.tr);
        if (step.correction) game.player.placeAt(*step.correction, game.settings.movement);
        if (step.hasEnded) leave(game.leaving, true);
    }
    if (const auto result = breakAndBuild(game.interaction, session, game.player, game.hud, seconds))
        game.notices.say(refusalText(*result, game.tr));
    advanceHud(game.hud, game.player.pose(), game.settings, session, seconds);
    session.advance(gameSeconds, world::chunkOf(game.player.pose().position));
    game.sounds.update(game.player, isInMenu(game.menu), seconds);
    savePlayer(session, game.player, game.interaction.hotbar, game.settings, game.saved);
    parts.view.setHorizon({game.settings.graphics.horizon, game.settings.graphics.detail});
    parts.view.follow(cameraOf(game.player, game.settings), game.settings.graphics.viewDistance);
}

void applyGraphics(const GameParts& parts, const render::GraphicsSettings& now,
                   const render::GraphicsSettings& before) {
    if (now.mesh != before.mesh) parts.session.pipeline().setMeshOptions(now.mesh);
    if (now.viewDistance != before.viewDistance) {
        parts.renderer.setViewDistance(now.viewDistance);
        parts.session.pipeline().resendLight();
    }
}

// Applies settings that changed since the last frame, except render options, which configureRenderer()
// applies.
void applySettings(GameState& game) {
    const PlaySettings &now = game.settings, &before = game.applied;
    if (now == before) return;
    if (now.preset != before.preset || now.graphics != before.graphics) game.preset.end();
    applyGraphics(game.parts, now.graphics, before.graphics);
    if (now.movement != before.movement) game.player.setMovement(now.movement);
    if (now.fullScreen != before.fullScreen) game.parts.window.setFullScreen(now.fullScreen);
    if (now.resourcePack != before.resourcePack) {
        const auto changed = useResourcePack(game.parts, now.resourcePack);
        if (!changed) game.settings.resourcePack = before.resourcePack;
        game.notices.say(changed ? game.tr("textures loaded") : changed.error().message);
    }
    if (now.soundVolume != before.soundVolume) game.sounds.setVolume(now.soundVolume);
    if (now.language != before.language) game.tr = textsOf(now.language, game.parts.content);
    game.applied = game.settings;
}

// Whether there is changed content that is usable; else the world stays, and the error is shown.
bool hasNewContent(const GameOptions& options, Notices& notices) {
    if (!options.contentChanged || !options.contentChanged()) return false;
    const auto checked = options.checkContent();
    if (checked) return true;
    base::logWarning("{}", checked.error().message);
    notices.say(checked.error().message);
    return false;
}

void useVsync(GameState& game, Vsync vsync) {
    if (std::exchange(game.vsync, vsync) != vsync) game.parts.window.setVsync(vsync);
}

// Waits until the frame after the one that began at `begin` may begin.
void limitFrames(const GameState& game, double begin) {
    if (game.settings.frameLimit <= 0) return;
    Window& window = game.parts.window;
    const double left = begin + 1 / game.settings.frameLimit - window.timeSeconds();
    if (left > 0) window.pause(left);
}

base::Result<void> drawFrame(GameState& game, double seconds) {
    const glm::ivec2 size = game.parts.window.framebufferSize();
    if (size.x == 0 || size.y == 0) return {};  // minimised
    TERRANE_TRY(drawImage(game, size, seconds));
    drawInterface(game, seconds);
    game.parts.window.swapBuffers();
    ++game.frames;
    return {};
}

base::Result<void> drawFrames(GameState& game) {
    const GameParts& parts = game.parts;
    double last = parts.window.timeSeconds();
    while (!game.leaving.isAsked && !parts.window.shouldClose() && !parts.signals.stopRequested()) {
        parts.window.pollEvents();
        handleEvents(game);
        const double now = parts.window.timeSeconds(), seconds = now - last;
        last = now;
        game.meter.add(seconds);
        advance(game, seconds);
        applySettings(game);
        if (auto notice = game.shaders.reload(parts.renderer, parts.preview, game.seconds))
            game.notices.say(std::move(*notice));
        if (!game.leaving.isAsked && hasNewContent(game.options, game.notices))
            game.leaving = {.isAsked = true, .toTitle = false, .forReload = true};
        useVsync(game, game.preset.isMeasuring() ? Vsync::Off : game.settings.vsync);
        TERRANE_TRY(drawFrame(game, seconds));
        limitFrames(game, now);
        if (game.perfLog) game.perfLog->add(game.seconds, seconds, statisticsOf(game));
    }
    return {};
}

}  // namespace

base::Result<void> runGame(GameState& game) {
    if (!game.options.perfData.empty()) {
        auto log = TERRANE_TRY(PerfLog::create(game.options.perfData));
        game.perfLog = std::move(log);
    }
    const GameParts& parts = game.parts;
    const render::GraphicsSettings& graphics = game.settings.graphics;
    if (game.options.measuresPreset) game.preset.begin();
    parts.session.pipeline().setMeshOptions(graphics.mesh);
    parts.renderer.setViewDistance(graphics.viewDistance);
    game.sounds.setVolume(game.settings.soundVolume);
    base::Result<void> drawn, saved;
    do {
        drawn = drawFrames(game);
        game.untilThumbnail = kThumbnailPause;
        writeThumbnailOf(parts.renderer, game.options.thumbnail);
        savePlayer(parts.session, game.player, game.interaction.hotbar, game.settings, game.saved);
        saved = save(parts.session);
    } while (drawn && !saved && askBeforeLoss(game));
    game.preset.end();
    useVsync(game, Vsync::On);
    const glm::dvec3& p = game.player.pose().position;
    base::logInfo("closed after {} frames at {:.2f},{:.2f},{:.2f}", game.frames, p.x, p.y, p.z);
    if (game.perfLog) base::logInfo("most seconds had {} frames", game.meter.mode());
    if (!drawn && !saved) base::logError("{}", saved.error().message);
    if (!drawn || !saved) return drawn ? saved : drawn;
    return game.perfLog ? game.perfLog->finish() : base::Result<void>();
}

}  // namespace terrane::app
