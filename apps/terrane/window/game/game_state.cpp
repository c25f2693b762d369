#include "apps/terrane/window/game/game_state.h"

#include "terrane/view/camera_path.h"

namespace terrane::app {

GameState::GameState(const GameParts& given, const GameOptions& chosen)
    : parts(given),
      options(chosen),
      settings(chosen.settings),
      applied(chosen.settings),
      tr(textsOf(chosen.settings.language, given.content)),
      player(chosen.start, chosen.settings.movement),
      interaction(given.session.blocks()),
      bookmarks(game::bookmarkFiles(chosen.dataFolder)),
      imgui(given.window),
      building(chosen.dataFolder),
      sounds(given.session),
      preset(given.window, chosen.deviceName, chosen.isSoftwareRenderer),
      shaders(given.shaders) {
    remote.play = given.remote;
    interaction.hotbar = game::hotbarFrom(chosen.hotbar, given.session.blocks());
    hud.places = game::savedPlaces(given.session.store());
}

bool isInMenu(const GameState& game) {
    return game.menu.isPaused || game.menu.asksToQuit;
}

bool hasOpenDialog(const GameState& game) {
    return game.hud.hasDialog() || game.remote.chat.isTyping();
}

bool isInDialog(const GameState& game) {
    return isInMenu(game) || game.container || hasOpenDialog(game) || game.building.isAsking();
}

render::Camera cameraOf(const GameState& game) {
    return view::cameraOf(game.player.pose(), game.settings.fieldOfView);
}

bool hasWorldImage(const GameState& game) {
    return game.parts.renderer.size().x > 0;
}

BuildView buildViewOf(const GameState& game) {
    return {.session = game.parts.session,
            .tr = game.tr,
            .pose = game.player.pose(),
            .body = game.player.body(),
            .hand = game.interaction.block(),
            .shift = game.input.withShift,
            .control = game.input.withControl};
}

}  // namespace terrane::app
