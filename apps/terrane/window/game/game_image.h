// Draws the image of the world in the window, and applies render options.
#pragma once

#include "apps/terrane/window/game/game_state.h"

namespace terrane::app {

// Draws no world until the first shaders are compiled. `seconds`: since the last frame. Fails if the graphics
// card cannot draw at all.
base::Result<void> drawImage(GameState& game, glm::ivec2 size, double seconds);

// Replaces textures by those of a folder; empty: the built-in ones. After an error the world looks as before.
base::Result<void> useResourcePack(const GameParts& parts, const std::string& folder);

}  // namespace terrane::app
