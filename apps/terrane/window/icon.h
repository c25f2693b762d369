// The window's icon: a block of grass, painted from the game's own textures.
#pragma once

#include "terrane/gpu/window.h"

namespace terrane::app {

void setTerraneIcon(gpu::Window& window);

}  // namespace terrane::app
