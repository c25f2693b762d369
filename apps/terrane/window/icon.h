// Sets the window's icon: the side of a grass block, from the built-in textures.
#pragma once

#include "apps/terrane/window/window.h"

namespace terrane::app {

void setTerraneIcon(Window& window);

}  // namespace terrane::app
