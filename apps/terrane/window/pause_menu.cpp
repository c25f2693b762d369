#include "apps/terrane/window/pause_menu.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/key_help.h"
#include "apps/terrane/window/ui_style.h"

namespace terrane::app {

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

}  // namespace terrane::app
