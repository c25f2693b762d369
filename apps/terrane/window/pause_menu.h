// The menu of the paused game. Immediate mode: drawn each frame.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/terrane/window/key_bindings.h"
#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/text.h"

namespace terrane::app {

enum class PauseChoice : std::uint8_t { Resume, Settings, Help, ToTitle, Quit };

// None until a button is clicked, or chosen with the arrow keys and Enter.
std::optional<PauseChoice> drawPauseMenu(const Screen& screen, const KeyBindings& keys, const Texts& tr);

}  // namespace terrane::app
