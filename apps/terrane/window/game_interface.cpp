#include "apps/terrane/window/game_interface.h"

#include <utility>

#include "apps/terrane/window/container_dialog.h"
#include "apps/terrane/window/game_hud.h"
#include "apps/terrane/window/game_menu.h"
#include "apps/terrane/window/game_statistics.h"
#include "apps/terrane/window/loading_map.h"
#include "apps/terrane/window/panel.h"
#include "terrane/view/camera_pose.h"

namespace terrane::app {
namespace {

// The direction to the sun or moon; none without shadows.
std::optional<glm::vec3> shadowLightOf(const GameParts& parts) {
    const render::RenderOptions& options = parts.renderer.options();
    if (options.shadows == render::ShadowReach::Off || options.shading == render::Shading::Off)
        return std::nullopt;
    return world::environmentAt(static_cast<float>(parts.session.clock.timeDay)).lightDirection;
}

void drawLinesInWorld(const GameState& game, const Screen& screen, const render::Camera& camera) {
    const GameParts& parts = game.parts;
    if (game.debug.isAbove) {
        const int viewDistance = parts.view.viewDistance();
        drawDebugTopView(screen, debugTopCamera(camera, viewDistance), camera,
                         view::fogDistance(viewDistance), shadowLightOf(parts));
    } else if (const auto& target = game.interaction.target(); target && !game.hud.isHidden) {
        drawTarget(screen, camera, *target,
                   {parts.session.world(), parts.session.blocks(), game.settings.highContrast});
    }
}

void drawRemote(GameState& game, const Screen& screen, const render::Camera& camera) {
    if (!game.remote.play) return;
    if (!game.hud.isHidden && !game.debug.isAbove)
        drawNames(screen, camera, game.remote.others.names,
                  {game.parts.session.world(), game.parts.session.blocks()});
    if (drawRemoteTexts(screen, game.remote, game.seconds, game.tr)) captureMouse(game, true);
}

// Frees the cursor while the player types or chooses something.
void drawBuilding(GameState& game, const Screen& screen, const render::Camera& camera) {
    if (!game.debug.isAbove) game.building.draw(screen, camera, buildViewOf(game), game.seconds);
    if (auto message = game.building.takeMessage()) game.notices.say(std::move(*message));
    const bool asks = game.building.isAsking();
    if (asks != std::exchange(game.wasAsking, asks)) captureMouse(game, !asks);
}

void drawDebugPanels(GameState& game, const Screen& screen) {
    game::Session& session = game.parts.session;
    if (game.debug.showsLoading) drawLoadingMap(screen, session.pipeline(), session.tiles().table());
    if (!game.debug.showsPanel) return;
    drawStatistics(statisticsOf(game), screen.width - panelWidth() - 30 * uiScale());
    drawPanel(game.settings, session.clock, {game.options.isSoftwareRenderer, screen.width, screen.height});
}

// Closes the dialog if the chest is gone or out of reach.
void drawContainerDialog(GameState& game, const Screen& screen) {
    game::Session& session = game.parts.session;
    const world::BlockPos block = *game.container;
    if (!canUseContainer(session, block, game.player.pose().position)) return captureMouse(game, true);
    const auto image = [&](const std::string& item) {
        const world::BlockType* kind = session.blocks().find(item);
        return kind ? game.parts.preview.image(kind->id) : 0;
    };
    const auto name = [&](const std::string& item) {
        const world::BlockType* kind = session.blocks().find(item);
        return kind ? game.tr.block(*kind) : item;
    };
    const auto drawn =
        drawOpenContainer(screen, session, block, game.interaction.hotbar, {image, name}, game.tr);
    if (drawn) return;
    game.notices.say(drawn.error().message);
    captureMouse(game, true);
}

void drawMenu(GameState& game, const Screen& screen) {
    GameMenu& menu = game.menu;
    const store::SaveStatus status = game.parts.session.store().status();
    if (menu.asksToQuit) {
        if (const auto choice = drawQuitDialog(screen, status, game.tr)) answerQuitDialog(game, *choice);
        return;
    }
    if (menu.showsSettings) {
        const SettingsDialog::Input view{screen, game.tr, game.options.isSoftwareRenderer,
                                         &game.parts.session.clock};
        if (menu.settings.draw(game.settings, view)) closeOne(game);
    } else if (menu.isPaused) {
        if (const auto choice = drawPauseMenu(screen, game.settings.keys, game.tr))
            answerPauseMenu(game, *choice);
    }
    drawSaveNotice(screen, status, game.tr);
}

}  // namespace

void drawInterface(GameState& game, double seconds) {
    game.imgui.setTextSize(game.settings.textSize);
    game.imgui.beginFrame(game.input.isCaptured, isInMenu(game) || hasOpenDialog(game));
    const Screen screen{game.imgui.size().x, game.imgui.size().y};
    const render::Camera camera = cameraOf(game);
    const stream::Progress progress = game.parts.session.pipeline().progress();
    drawLinesInWorld(game, screen, camera);
    drawRemote(game, screen, camera);
    drawBuilding(game, screen, camera);
    if (game.input.isCaptured && !game.debug.isAbove && !game.hud.isHidden) drawCrosshair(screen);
    drawHud(game, screen, camera, seconds);
    drawNotices(screen, game.notices, game.settings.keys, game.tr);
    game.wasComplete = game.wasComplete || progress.complete();
    if (!game.wasComplete) drawProgress(screen, progress, game.tr);
    drawDebugPanels(game, screen);
    if (game.container) drawContainerDialog(game, screen);
    drawMenu(game, screen);
    game.imgui.endFrame();
}

}  // namespace terrane::app
