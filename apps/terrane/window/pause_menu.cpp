#include "apps/terrane/window/pause_menu.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "apps/terrane/window/imgui_layer.h"

namespace terrane::app {

std::optional<PauseChoice> drawPauseMenu(const Screen& screen, const Texts& tr) {
    const std::pair<const char*, PauseChoice> buttons[] = {{tr("Resume (Esc)"), PauseChoice::Resume},
                                                           {tr("Settings (F2)"), PauseChoice::Settings},
                                                           {tr("Keys (F1)"), PauseChoice::Help},
                                                           {tr("Save and quit (Q)"), PauseChoice::Quit}};
    std::optional<PauseChoice> choice;
    const float width = std::min(220 * uiScale(), screen.width - 20 * uiScale());
    ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, {screen.width, screen.height},
                                                  IM_COL32(0, 0, 0, 90));
    ImGui::SetNextWindowPos({screen.width / 2, screen.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::Begin(tr("Paused"), nullptr,
                 ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse);
    if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
    for (const auto& [label, meaning] : buttons) {
        if (ImGui::Button(label, {-1, 30 * uiScale()})) choice = meaning;
        if (meaning == PauseChoice::Resume) ImGui::SetItemDefaultFocus();
    }
    ImGui::End();
    return choice;
}

}  // namespace terrane::app
