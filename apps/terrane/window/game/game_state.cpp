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
      itemImages(given.content.textures),
      building(chosen.dataFolder),
      sounds(given.session),
      preset(chosen.deviceName, chosen.isSoftwareRenderer),
      shaders(given.shaders) {
    remote.play = given.remote;
    said = given.session.events.said.add([this](const game::Said& line) {
        remote.chat.add({{}, line.text}, seconds);
    });
    interaction.hotbar = game::parseHotbar(chosen.hotbar, given.session.blocks());
    hud.places = game::savedPlaces(given.session.store());
    if (!settings.hintSeen) notices.hintSeconds = Notices::kHintSeconds;
    settings.hintSeen = applied.hintSeen = true;
}

bool isInMenu(const GameMenu& menu) {
    return menu.isPaused || menu.asksToQuit;
}

bool hasOpenDialog(const Hud& hud, const ChatView& chat) {
    return hud.hasDialog() || chat.isTyping();
}

bool isInSurvival(const GameState& game) {
    return game.parts.session.modeOf(game::kLocalPlayer) == game::Mode::Survival;
}

bool isInDialog(const GameState& game) {
    return isInMenu(game.menu) || game.container || hasOpenDialog(game.hud, game.remote.chat) ||
           game.building.isAsking();
}

render::Camera cameraOf(const game::Player& player, const PlaySettings& settings) {
    return view::cameraOf(player.pose(), settings.fieldOfView);
}

bool hasWorldImage(const render::Renderer& renderer) {
    return renderer.size().x > 0;
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
