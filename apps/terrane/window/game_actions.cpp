#include "apps/terrane/window/game_actions.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "apps/terrane/window/edit_texts.h"
#include "apps/terrane/window/game_menu.h"
#include "apps/terrane/window/pictures.h"
#include "terrane/game/spawn.h"

namespace terrane::app {
namespace {

constexpr double kDayStep = 0.01;  // of a day, per press

// Indexed by game::Movement.
constexpr std::array<const char*, 4> kMovementTexts = {
    trLater("movement: flying fast, through blocks"), trLater("movement: flying slowly, through blocks"),
    trLater("movement: flying, with collisions"), trLater("movement: walking")};

void flip(bool& value) {
    value = !value;
}

void openPalette(GameState& game) {
    if (game.hud.palette.isOpen) return captureMouse(game, true);
    captureMouse(game, false);
    game.hud.palette.open();
}

void openPlaces(GameState& game) {
    captureMouse(game, false);
    game.hud.placesDialog.open();
}

void beginChat(GameState& game) {
    if (!game.remote.play) return;
    captureMouse(game, false);
    game.remote.chat.beginTyping();
}

void showPanel(GameState& game) {
    game.debug.showsPanel = !game.debug.showsPanel;
    if (game.debug.showsPanel) captureMouse(game, false);
}

void nextLight(GameState& game) {
    using render::LightSampling;
    LightSampling& light = game.settings.graphics.render.light;
    light = light == LightSampling::Smooth ? LightSampling::Classic : LightSampling::Smooth;
    game.notices.say(light == LightSampling::Smooth ? game.tr("smooth light") : game.tr("classic light"));
}

void nextMovement(GameState& game) {
    const std::size_t next = (static_cast<std::size_t>(game.settings.movement) + 1) % kMovementTexts.size();
    game.settings.movement = static_cast<game::Movement>(next);
    game.notices.say(game.tr(kMovementTexts[next]));
}

void changeTime(GameState& game, Action action) {
    game::DayClock& clock = game.parts.session.clock;
    if (game.remote.play) return game.notices.say(game.tr("the server sets the time"));
    if (action != Action::HoldTime) return clock.shift(action == Action::Later ? kDayStep : -kDayStep);
    clock.isRunning = !clock.isRunning;
    game.notices.say(clock.isRunning ? game.tr("time runs") : game.tr("time is stopped"));
}

void saveBookmark(GameState& game) {
    const auto done = game::appendBookmark(game.bookmarks.file, game.player.pose());
    game.notices.say(
        done ? fmt::format(fmt::runtime(game.tr("bookmark saved in {}")), game.bookmarks.file.string())
             : done.error().message);
}

void nextBookmark(GameState& game) {
    const auto bookmarks = game::readBookmarks(game.bookmarks);
    if (!bookmarks) return game.notices.say(bookmarks.error().message);
    if (bookmarks->empty()) return game.notices.say(game.tr("no bookmark is saved yet"));
    game.player.placeAt((*bookmarks)[game.nextBookmark++ % bookmarks->size()], game.settings.movement);
}

void goToSpawn(GameState& game) {
    const game::Session& session = game.parts.session;
    if (!game.hud.spawn) game.hud.spawn = game::findSpawn(session.generator(), session.blocks());
    game.player.placeAt(*game.hud.spawn, game.settings.movement);
    game.notices.say(game.tr("back at the spawn"));
}

void takeScreenshot(GameState& game) {
    if (!hasWorldImage(game)) return;
    const base::Image image = game.parts.renderer.readImage();
    const auto file = writeScreenshot(game.options.dataFolder / "screenshots", image);
    if (file) game.hud.screenshot.show(image);
    game.notices.say(file ? fmt::format(fmt::runtime(game.tr("screenshot {}")), file->string())
                          : file.error().message);
}

}  // namespace

void act(GameState& game, Action action) {
    switch (action) {
        case Action::Help:
            game.notices.helpSeconds = game.notices.helpSeconds > 0 ? 0 : Notices::kHelpSeconds;
            break;
        case Action::Panel:
            return showPanel(game);
        case Action::TopView:
            return flip(game.debug.isAbove);
        case Action::LoadingMap:
            return flip(game.debug.showsLoading);
        case Action::SaveBookmark:
            return saveBookmark(game);
        case Action::NextBookmark:
            return nextBookmark(game);
        case Action::Facts:
            return flip(game.hud.showsFacts);
        case Action::HideHud:
            return flip(game.hud.isHidden);
        case Action::FullScreen:
            return flip(game.settings.fullScreen);
        case Action::Screenshot:
            return takeScreenshot(game);
        case Action::Chat:
            return beginChat(game);
        case Action::PlayerList:
            game.remote.showsPlayers = game.remote.play && !game.remote.showsPlayers;
            break;
        case Action::Earlier:
        case Action::Later:
        case Action::HoldTime:
            return changeTime(game, action);
        case Action::Light:
            return nextLight(game);
        case Action::Movement:
            return nextMovement(game);
        case Action::Palette:
            return openPalette(game);
        case Action::Places:
            return openPlaces(game);
        case Action::Spawn:
            return goToSpawn(game);
        default:  // held keys
            break;
    }
}

void breakAndBuild(GameState& game, double seconds) {
    game::Session& session = game.parts.session;
    const auto& target = game.interaction.target();
    const std::optional<world::BlockPos> pos = target ? std::optional(target->block) : std::nullopt;
    const world::BlockId before = pos ? session.world().block(*pos) : world::kAir;
    const auto result = game.interaction.act(session, game::kLocalPlayer, game.player, seconds);
    if (!result) return;
    game.hud.hand.swing();
    if (std::string text = refusalText(*result, game.tr); !text.empty()) game.notices.say(std::move(text));
    if (pos && before != world::kAir && session.world().block(*pos) == world::kAir)
        game.hud.particles.burst(*pos, before);
}

void takeBack(GameState& game, game::HistoryWay way) {
    const auto done = game.parts.session.takeBack(game::kLocalPlayer, way);
    std::string text = takenBackText(done, way, game.tr);
    if (!text.empty()) game.notices.say(std::move(text));
}

void writeThumbnailOf(GameState& game) {
    game.untilThumbnail = kThumbnailPause;
    if (game.options.thumbnail.empty() || !hasWorldImage(game)) return;
    writeThumbnail(game.options.thumbnail, game.parts.renderer.readImage());
}

}  // namespace terrane::app
