#include "apps/terrane/window/settings/play_settings.h"

#include <fmt/format.h>

#include <array>

namespace terrane::app {

EnumNames<game::Movement> movementNames() {
    static const std::array<std::pair<std::string, game::Movement>, 4> valueNames = {
        {{"fast", game::Movement::Fast},
         {"medium", game::Movement::Medium},
         {"walls", game::Movement::Walls},
         {"gravity", game::Movement::Gravity}}};
    return valueNames;
}

const std::string& nameOf(game::Movement movement) {
    return movementNames()[static_cast<std::size_t>(movement)].first;
}

std::optional<game::Movement> movementNamed(std::string_view name) {
    for (const auto& [known, movement] : movementNames())
        if (known == name) return movement;
    return std::nullopt;
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
    values.emplace("field-of-view", fmt::format("{:.0f}", s.fieldOfView));
    values.emplace("mouse-sensitivity", fmt::format("{:.2f}", s.mouseSensitivity));
    values.emplace("sound-volume", fmt::format("{:.2f}", s.soundVolume));
    values.emplace("day-minutes", fmt::format("{:.1f}", s.dayMinutes));
    if (s.fullScreen) values.emplace("full-screen", "true");
    if (const std::string keys = textOf(s.keys); !keys.empty()) values.emplace("keys", keys);
    if (s.invertY) values.emplace("invert-y", "true");
    if (s.autoJump) values.emplace("auto-jump", "true");
    if (s.textSize != 1) values.emplace("text-size", fmt::format("{:.2f}", s.textSize));
    if (s.highContrast) values.emplace("high-contrast", "true");
    if (s.reducedMotion) values.emplace("reduced-motion", "true");
    if (s.language != "auto") values.emplace("language", s.language);
    return values;
}

}  // namespace terrane::app
