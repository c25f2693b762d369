#include "apps/terrane/window/settings/panel.h"

#include <imgui.h>

#include <array>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/settings/settings_dialog.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

// A combo box of `count` names; true if another one was chosen.
template <class NameOf>
bool combo(const char* label, int& chosen, int count, NameOf nameOf) {
    const std::string current(chosen >= 0 && chosen < count ? nameOf(chosen) : "custom");
    if (!ui::beginCombo(label, current.c_str())) return false;
    bool isChanged = false;
    for (int k = 0; k < count; ++k) {
        if (!ui::selectable(std::string(nameOf(k)).c_str(), k == chosen)) continue;
        isChanged = k != chosen;
        chosen = k;
    }
    ImGui::EndCombo();
    return isChanged;
}

template <class T>
void choice(const char* label, T& value, EnumNames<T> valueNames) {
    int chosen = -1;
    for (std::size_t k = 0; k < valueNames.size(); ++k) {
        if (valueNames[k].second == value) chosen = static_cast<int>(k);
    }
    const auto nameOf = [&](int k) { return valueNames[static_cast<std::size_t>(k)].first; };
    if (combo(label, chosen, static_cast<int>(valueNames.size()), nameOf)) {
        value = valueNames[static_cast<std::size_t>(chosen)].second;
    }
}

void tooltip(std::string_view text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%.*s", static_cast<int>(text.size()), text.data());
}

void drawPreset(PlaySettings& settings, bool isSoftwareRenderer) {
    const auto nameOf = [](int k) {
        return k == 0 ? std::string_view("auto") : render::presets()[static_cast<std::size_t>(k - 1)].name;
    };
    const int count = static_cast<int>(render::presets().size()) + 1;
    int chosen = 0;
    for (int k = 0; k < count; ++k) {
        if (nameOf(k) == settings.preset) chosen = k;
    }
    if (!combo("preset", chosen, count, nameOf)) return;
    settings.preset = nameOf(chosen);
    settings.graphics = render::withPreset(settings.graphics, settings.preset, isSoftwareRenderer);
}

// Applied with Enter.
void drawResourcePack(PlaySettings& s) {
    std::array<char, 512> folder{};
    s.resourcePack.copy(folder.data(), folder.size() - 1);
    if (ui::textField("resource pack", "", folder.data(), folder.size(),
                      ImGuiInputTextFlags_EnterReturnsTrue))
        s.resourcePack = folder.data();
    tooltip("Folder of PNG files named as textures; Enter takes it");
}

void drawClock(game::DayClock& day) {
    auto time = static_cast<float>(day.timeDay);
    if (ui::slider("time of day", &time, 0, 1, "%.3f")) day.timeDay = double{time};
    ui::checkbox("time runs", &day.isRunning);
}

}  // namespace

void drawPanel(OverlayLayout& layout, PlaySettings& settings, game::DayClock& day, bool isSoftwareRenderer) {
    const float scale = uiScale();
    if (!layout.beginWindow({.title = "Settings", .id = "panel", .width = 280 * scale},
                            {.alignX = 1, .minHeight = 80 * scale}))
        return;
    ImGui::PushItemWidth(120 * scale);
    drawPreset(settings, isSoftwareRenderer);
    choice("view", settings.view, viewNames());
    ImGui::Separator();
    for (const Setting& setting : settingsTable()) drawSetting(setting, settings, nullptr);
    ImGui::Separator();
    drawResourcePack(settings);
    drawClock(day);
    ImGui::PopItemWidth();
    ImGui::End();
}

}  // namespace terrane::app
