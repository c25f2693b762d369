#include "apps/terrane/window/settings/play_settings.h"

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

}  // namespace terrane::app
