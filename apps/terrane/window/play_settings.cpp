#include "apps/terrane/window/play_settings.h"

#include <fmt/format.h>

#include <array>

namespace terrane::app {
namespace {

template <class T>
std::string nameOf(EnumNames<T> valueNames, T value) {
    for (const auto& [name, meaning] : valueNames) {
        if (meaning == value) return name;
    }
    return {};
}

}  // namespace

EnumNames<game::Movement> movementNames() {
    static const std::array<std::pair<std::string, game::Movement>, 4> valueNames = {
        {{"fast", game::Movement::Fast},
         {"medium", game::Movement::Medium},
         {"walls", game::Movement::Walls},
         {"gravity", game::Movement::Gravity}}};
    return valueNames;
}

SettingValues valuesOf(const PlaySettings& s, bool isSoftwareRenderer) {
    SettingValues values = {{"preset", s.preset}};
    const render::GraphicsSettings preset = render::settingsOf({s.preset}, isSoftwareRenderer);
    for (const render::GraphicsRow& row : render::graphicsTable()) {
        const int value = row.get(s.graphics);
        if (value == row.get(preset)) continue;
        values.emplace(row.name, row.valueNames[static_cast<std::size_t>(value)]);
    }
    values.emplace("view-distance", fmt::format("{}", s.graphics.viewDistance));
    values.emplace("movement", nameOf(movementNames(), s.movement));
    values.emplace("field-of-view", fmt::format("{:.0f}", s.fieldOfView));
    values.emplace("mouse-sensitivity", fmt::format("{:.2f}", s.mouseSensitivity));
    values.emplace("sound-volume", fmt::format("{:.2f}", s.soundVolume));
    values.emplace("day-minutes", fmt::format("{:.1f}", s.dayMinutes));
    if (s.fullScreen) values.emplace("full-screen", "true");
    if (s.language != "auto") values.emplace("language", s.language);
    if (!s.resourcePack.empty()) values.emplace("resource-pack", s.resourcePack);
    return values;
}

}  // namespace terrane::app
