#include "apps/terrane/window/game/game_menu.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/settings/key_help.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {

namespace {

const ImVec4 kWarning{0.45f, 0.05f, 0.02f, 0.9f};

constexpr float kNoticeWidth = 520;  // before scaling

void drawProblem(const store::SaveStatus& status, const Texts& tr) {
    ui::wrappedText(status.problem);
    ImGui::TextWrapped(
        tr("For %.0f s. %zu chunks are waiting; the program keeps trying. Nothing is lost while it runs."),
        status.failingSeconds, status.waiting);
}

}  // namespace

void drawSaveNotice(OverlayLayout& layout, const store::SaveStatus& status, const Texts& tr) {
    if (status.problem.empty()) return;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, kWarning);
    const bool isShown = layout.beginWindow(
        {.id = "save notice", .width = kNoticeWidth * uiScale(), .flags = OverlayLayout::kBare},
        {.alignX = 0.5f, .minHeight = ImGui::GetTextLineHeightWithSpacing()});
    ImGui::PopStyleColor();
    if (!isShown) return;
    ImGui::TextUnformatted(tr("The world is not being saved"));
    drawProblem(status, tr);
    ImGui::End();
}

std::optional<QuitChoice> drawQuitDialog(const Screen& screen, const store::SaveStatus& status,
                                         const Texts& tr) {
    std::optional<QuitChoice> choice;
    const float width = std::min(kNoticeWidth * uiScale(), screen.width - 20 * uiScale());
    ImGui::SetNextWindowPos({screen.width / 2, screen.height * 0.35f}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, kWarning);
    ui::beginWindow(tr("The world could not be saved"),
                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse);
    ImGui::PopStyleColor();
    if (status.problem.empty()) {
        ui::wrappedText(tr("Saving works again."));
    } else {
        drawProblem(status, tr);
    }
    ImGui::Spacing();
    if (ui::button(tr("Try again and quit"))) choice = QuitChoice::TryAgain;
    ImGui::SameLine();
    if (ui::button(tr("Keep playing"))) choice = QuitChoice::Stay;
    ImGui::SameLine();
    if (ui::button(tr("Quit without saving"))) choice = QuitChoice::QuitUnsaved;
    ImGui::End();
    return choice;
}

std::optional<PauseChoice> drawPauseMenu(const Screen& screen, const KeyBindings& keys, const Texts& tr) {
    const std::string help = fmt::format("{} ({})", tr("Keys"), keyText(keys.keyOf(Action::Help), tr));
    const std::pair<const char*, PauseChoice> buttons[] = {
        {tr("Resume (Esc)"), PauseChoice::Resume},
        {tr("Settings"), PauseChoice::Settings},
        {help.c_str(), PauseChoice::Help},
        {tr("Save and quit to title (T)"), PauseChoice::ToTitle},
        {tr("Save and quit (Q)"), PauseChoice::Quit}};
    std::optional<PauseChoice> choice;
    ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, {screen.width, screen.height},
                                                  IM_COL32(0, 0, 0, 90));
    const float width = std::min(240 * uiScale(), screen.width - 20 * uiScale());
    beginMenu({tr("Paused"), {screen.width / 2, screen.height / 2}, {width, 0}});
    for (const auto& [label, meaning] : buttons) {
        if (menuButton(label)) choice = meaning;
        if (meaning == PauseChoice::Resume && ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    }
    ImGui::End();
    return choice;
}

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

// What lies in the grid goes back to the player's slots.
void clearCraftingGrid(GameState& game) {
    if (!game.hud.inventory.isOpen) return;
    game::Session& session = game.parts.session;
    const game::PlayerItems& items = session.itemsOf(game::kLocalPlayer);
    for (const game::ItemAction& action : clearGrid(items, session.blocks().items()))
        (void)session.act(game::kLocalPlayer, action);
}

}  // namespace

void captureMouse(GameState& game, bool isCaptured) {
    game.input.isCaptured = isCaptured;
    game.parts.window.setCursorCaptured(isCaptured);
    if (isCaptured) {
        game.imgui.endTyping();
        clearCraftingGrid(game);
        game.container.reset();
        game.hud.closeDialog();
        game.remote.chat.endTyping();
    }
    game.interaction.breaking.cancel();
    game.interaction.building.cancel();
}

void leave(Leaving& leaving, bool toTitle) {
    leaving.toTitle = toTitle;
    leaving.isAsked = true;
}

void closeOne(GameState& game) {
    GameMenu& menu = game.menu;
    if (game.imgui.hasPopup()) return game.imgui.endTyping();
    if (menu.asksToQuit) return answerQuitDialog(game, QuitChoice::Stay);
    if (game.container || hasOpenDialog(game.hud, game.remote.chat)) return captureMouse(game, true);
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
            return leave(game.leaving, true);
        case PauseChoice::Quit:
            return leave(game.leaving, false);
    }
}

bool askBeforeLoss(GameState& game) {
    if (game.menu.quitsUnsaved || game.parts.signals.stopRequested()) return false;
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
