// The image of the world in the window: the options it is drawn with, and a frame.
#pragma once

#include "apps/terrane/window/game_state.h"

namespace terrane::app {

// Without an image until the first shaders are compiled; `seconds`: since the frame before. An error:
// the graphics card cannot draw at all.
base::Result<void> drawImage(GameState& game, glm::ivec2 size, double seconds);

// Replaces textures by those of a folder; empty: the built-in ones. What is wrong with them changes nothing.
base::Result<void> useResourcePack(const GameParts& parts, const std::string& folder);

}  // namespace terrane::app
