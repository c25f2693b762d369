// The window's icon: a block of grass, painted from the game's own textures.
#pragma once

#include "apps/terrane/window/window.h"

namespace terrane::app {

void setTerraneIcon(Window& window);

}  // namespace terrane::app
