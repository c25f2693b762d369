#include "apps/terrane/window/game/game.h"

#include <utility>

#include "apps/terrane/window/game/game_image.h"
#include "apps/terrane/window/game/game_input.h"
#include "apps/terrane/window/game/game_interface.h"
#include "apps/terrane/window/game/game_menu.h"
#include "apps/terrane/window/game/game_statistics.h"
#include "terrane/base/log.h"
#include "terrane/game/spawn.h"

namespace terrane::app {
namespace {

game::PlayerState playerStateOf(const GameState& game) {
    const PlaySettings& settings = game.settings;
    return {.pose = game.player.pose(),
            .timeDay = game.parts.session.clock.timeDay,
            .hotbar = game::textOf(game.interaction.hotbar, game.parts.session.blocks()),
            .movement = nameOf(settings.movement),
            // Absolute, to be found from another working directory.
            .resourcePack = settings.resourcePack.empty()
                                ? ""
                                : std::filesystem::absolute(settings.resourcePack).string()};
}

base::Result<void> save(GameState& game) {
    game::Session& session = game.parts.session;
    game::savePlayer(session.store(), playerStateOf(game), game.saved);
    const auto saved = session.save();
    if (saved) return saved;
    return base::fail(saved.error().code, "{}; not saved: {} chunks", saved.error().message,
                      session.store().status().waiting);
}

// Moves a player on foot below the world to the surface, since it would fall forever.
void liftFromBelow(GameState& game) {
    const game::Movement movement = game.settings.movement;
    if (movement == game::Movement::Fast || movement == game::Movement::Medium) return;
    const game::Session& session = game.parts.session;
    const auto lifted = game::backOnSurface(session.world(), session.blocks(), game.player.pose());
    if (!lifted) return;
    game.player.placeAt(*lifted, movement);
    game.notices.say(game.tr("you fell out of the world and are back on the ground"));
}

void exchangeWithServer(GameState& game) {
    if (!game.remote.play) return;
    const RemoteStep step =
        advanceRemote(game.remote, game.player.pose(), game.settings, game.seconds, game.notices, game.tr);
    if (step.correction) game.player.placeAt(*step.correction, game.settings.movement);
    if (step.hasEnded) leave(game, true);
}

void advance(GameState& game, double seconds) {
    const GameParts& parts = game.parts;
    game::Session& session = parts.session;
    game.seconds += seconds;
    game.notices.advance(seconds);
    game.untilThumbnail -= seconds;
    if (game.untilThumbnail <= 0) writeThumbnailOf(game);
    if (!game.remote.play) session.clock.dayMinutes = game.settings.dayMinutes;
    handlePad(game, seconds);
    passHeldTime(game, seconds);
    const double gameSeconds = isInMenu(game) ? 0 : seconds;
    game.player.move(session.world(), session.blocks(), moveKeysOf(game), gameSeconds);
    liftFromBelow(game);
    session.setPlayer(game::kLocalPlayer, game.player.pose());
    exchangeWithServer(game);
    breakAndBuild(game, seconds);
    advanceHud(game, seconds);
    session.advance(gameSeconds, world::chunkOf(game.player.pose().position));
    game.sounds.update(game.player, isInMenu(game), seconds);
    game::savePlayer(session.store(), playerStateOf(game), game.saved);
    parts.view.setHorizon({game.settings.graphics.horizon, game.settings.graphics.detail});
    parts.view.follow(cameraOf(game), game.settings.graphics.viewDistance);
}

void applyGraphics(GameState& game) {
    const render::GraphicsSettings &now = game.settings.graphics, &before = game.applied.graphics;
    if (game.settings.preset != game.applied.preset || now != before) game.preset.end();
    if (now.mesh != before.mesh) game.parts.session.pipeline().setMeshOptions(now.mesh);
    if (now.viewDistance != before.viewDistance) {
        game.parts.renderer.setViewDistance(now.viewDistance);
        game.parts.session.pipeline().resendLight();
    }
}

void applyResourcePack(GameState& game) {
    const auto changed = useResourcePack(game.parts, game.settings.resourcePack);
    if (!changed) game.settings.resourcePack = game.applied.resourcePack;
    game.notices.say(changed ? game.tr("textures loaded") : changed.error().message);
}

// Applies settings that changed since the last frame, except render options, which configureRenderer()
// applies.
void applySettings(GameState& game) {
    const PlaySettings &now = game.settings, &before = game.applied;
    if (now == before) return;
    applyGraphics(game);
    if (now.movement != before.movement) game.player.setMovement(now.movement);
    if (now.fullScreen != before.fullScreen) game.parts.window.setFullScreen(now.fullScreen);
    if (now.resourcePack != before.resourcePack) applyResourcePack(game);
    if (now.soundVolume != before.soundVolume) game.sounds.setVolume(now.soundVolume);
    if (now.language != before.language) game.tr = textsOf(now.language, game.parts.content);
    game.applied = game.settings;
}

// Reloads changed content if it is usable; else the world stays, and the error is shown.
void reloadContent(GameState& game) {
    const GameOptions& options = game.options;
    if (!options.contentChanged || game.leaving.isAsked || !options.contentChanged()) return;
    if (const auto checked = options.checkContent(); !checked) {
        base::logWarning("{}", checked.error().message);
        return game.notices.say(checked.error().message);
    }
    game.leaving.forReload = true;
    leave(game, false);
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
    while (!game.leaving.isAsked && !parts.window.shouldClose() && !parts.signals.stopAsked()) {
        parts.window.pollEvents();
        handleEvents(game);
        const double now = parts.window.timeSeconds(), seconds = now - last;
        last = now;
        game.meter.add(seconds);
        advance(game, seconds);
        applySettings(game);
        if (auto notice = game.shaders.reload(parts.renderer, parts.preview, game.seconds))
            game.notices.say(std::move(*notice));
        reloadContent(game);
        TERRANE_TRY(drawFrame(game, seconds));
        if (game.perfLog) game.perfLog->add(game.seconds, seconds, statisticsOf(game));
    }
    return {};
}

void begin(GameState& game) {
    const render::GraphicsSettings& graphics = game.settings.graphics;
    if (game.options.measuresPreset) game.preset.begin();
    game.parts.session.pipeline().setMeshOptions(graphics.mesh);
    game.parts.renderer.setViewDistance(graphics.viewDistance);
    game.sounds.setVolume(game.settings.soundVolume);
}

}  // namespace

base::Result<void> runGame(GameState& game) {
    if (!game.options.perfData.empty()) {
        auto log = TERRANE_TRY(PerfLog::create(game.options.perfData));
        game.perfLog = std::move(log);
    }
    begin(game);
    base::Result<void> drawn, saved;
    do {
        drawn = drawFrames(game);
        writeThumbnailOf(game);
        saved = save(game);
    } while (drawn && !saved && askBeforeLoss(game));
    game.preset.end();
    const glm::dvec3& p = game.player.pose().position;
    base::logInfo("closed after {} frames at {:.2f},{:.2f},{:.2f}", game.frames, p.x, p.y, p.z);
    if (game.perfLog) base::logInfo("most seconds had {} frames", game.meter.mode());
    if (!drawn && !saved) base::logError("{}", saved.error().message);
    if (!drawn || !saved) return drawn ? saved : drawn;
    return game.perfLog ? game.perfLog->finish() : base::Result<void>();
}

}  // namespace terrane::app
