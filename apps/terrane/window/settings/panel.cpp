#include "apps/terrane/window/settings/panel.h"

#include <imgui.h>

#include <array>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/text.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

// Clamps numbers typed after a Ctrl+click too.
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

// A checkbox for rows with values off and on, else a combo box.
void drawRow(const render::GraphicsRow& row, render::GraphicsSettings& graphics) {
    const std::string label(row.name);
    int value = row.get(graphics);
    bool isChanged = false;
    if (row.valueNames[0] == "off" && row.valueNames.size() == 2) {
        bool isOn = value == 1;
        isChanged = ui::checkbox(label.c_str(), &isOn);
        value = isOn ? 1 : 0;
    } else {
        const auto nameOf = [&](int k) { return row.valueNames[static_cast<std::size_t>(k)]; };
        isChanged = combo(label.c_str(), value, static_cast<int>(row.valueNames.size()), nameOf);
    }
    tooltip(row.description);
    if (isChanged) row.set(graphics, value);
}

void drawView(PlaySettings& s) {
    choice("view", s.view, viewNames());
    ui::slider("view distance", &s.graphics.viewDistance, 2, 64, "%d");
    ui::slider("field of view", &s.fieldOfView, 40, 110, "%.0f");
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

void drawPlayer(PlaySettings& s, game::DayClock& day) {
    choice("movement", s.movement, movementNames());
    ui::slider("sound volume", &s.soundVolume, 0, 1, "%.2f");
    ui::slider("mouse", &s.mouseSensitivity, 0.02f, 0.6f, "%.2f");
    ui::checkbox("full screen", &s.fullScreen);
    const auto languages = languageChoices();
    choice<std::string>("language", s.language, languages);
    float time = static_cast<float>(day.timeDay);
    if (ui::slider("time of day", &time, 0, 1, "%.3f")) day.timeDay = double{time};
    ui::checkbox("time runs", &day.isRunning);
    float minutes = static_cast<float>(s.dayMinutes);
    if (ui::slider("minutes per day", &minutes, 0.5f, 60, "%.1f")) s.dayMinutes = double{minutes};
}

}  // namespace

float panelWidth() {
    return 280 * uiScale();
}

void drawPanel(PlaySettings& settings, game::DayClock& day, const PanelInput& input) {
    const float scale = uiScale(), width = panelWidth(), margin = 10 * scale;
    ImGui::SetNextWindowPos({input.width - width - margin, margin});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, input.height - 2 * margin});
    ui::beginWindow("Settings", ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize);
    ImGui::PushItemWidth(120 * scale);
    drawPreset(settings, input.isSoftwareRenderer);
    drawView(settings);
    ImGui::Separator();
    for (const render::GraphicsRow& row : render::graphicsTable()) drawRow(row, settings.graphics);
    ImGui::Separator();
    drawResourcePack(settings);
    drawPlayer(settings, day);
    ImGui::PopItemWidth();
    ImGui::End();
}

}  // namespace terrane::app
