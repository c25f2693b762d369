#include "apps/terrane/window/game_menu.h"

namespace terrane::app {
namespace {

void pause(GameState& game) {
    game.menu.isPaused = true;
    game.notices.helpSeconds = 0;
    captureMouse(game, false);
}

void resume(GameState& game) {
    game.menu.isPaused = false;
    captureMouse(game, true);
}

}  // namespace

void captureMouse(GameState& game, bool isCaptured) {
    game.input.isCaptured = isCaptured;
    game.parts.window.setCursorCaptured(isCaptured);
    if (isCaptured) {
        game.imgui.endTyping();
        game.container.reset();
        game.hud.closeDialog();
        game.remote.chat.endTyping();
    }
    game.interaction.breaking.cancel();
    game.interaction.building.cancel();
}

void leave(GameState& game, bool toTitle) {
    game.leaving.toTitle = toTitle;
    game.leaving.isAsked = true;
}

void closeOne(GameState& game) {
    GameMenu& menu = game.menu;
    if (game.imgui.hasPopup()) return game.imgui.endTyping();
    if (menu.asksToQuit) return answerQuitDialog(game, QuitChoice::Stay);
    if (game.container || hasOpenDialog(game)) return captureMouse(game, true);
    if (menu.showsSettings) {
        menu.showsSettings = false;
        return;
    }
    if (game.building.close()) return;
    if (game.debug.showsPanel) {
        game.debug.showsPanel = false;
        if (!menu.isPaused) captureMouse(game, true);
        return;
    }
    menu.isPaused ? resume(game) : pause(game);
}

void answerPauseMenu(GameState& game, PauseChoice choice) {
    game.sounds.click();
    switch (choice) {
        case PauseChoice::Resume:
            return resume(game);
        case PauseChoice::Settings:
            game.menu.settings.open();
            game.menu.showsSettings = true;
            return;
        case PauseChoice::Help:
            resume(game);
            game.notices.helpSeconds = Notices::kHelpSeconds;
            return;
        case PauseChoice::ToTitle:
            return leave(game, true);
        case PauseChoice::Quit:
            return leave(game, false);
    }
}

bool askBeforeLoss(GameState& game) {
    if (game.menu.quitsUnsaved || game.parts.signals.stopAsked()) return false;
    game.parts.window.cancelClose();
    game.leaving.isAsked = false;
    game.menu.asksToQuit = true;
    captureMouse(game, false);
    return true;
}

void answerQuitDialog(GameState& game, QuitChoice choice) {
    game.menu.asksToQuit = false;
    game.menu.quitsUnsaved = choice == QuitChoice::QuitUnsaved;
    game.leaving.isAsked = true;
    if (choice == QuitChoice::Stay) game.leaving = {};
    if (choice == QuitChoice::QuitUnsaved) game.leaving.forReload = false;
}

}  // namespace terrane::app
