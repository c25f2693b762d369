// Moves through menus with a gamepad.
#pragma once

#include <imgui.h>

#include <optional>

#include "apps/terrane/window/input.h"

namespace terrane::app {

// Sets Dear ImGui's inputs of a gamepad: d-pad or left stick, lower and right button. Its own back end
// numbers the buttons as the driver does, which differs between systems and pads; GLFW's mapping of known
// pads does not.
void setPadNavigation(const std::optional<Gamepad>& pad, float (&inputs)[ImGuiNavInput_COUNT]);

}  // namespace terrane::app
