// A GLFW window with an OpenGL 4.5 core context.
#pragma once

#include <memory>

#include "apps/terrane/window/window.h"

namespace terrane::app {

// Sets the window's icon: the side of a grass block, from the built-in textures.
void setTerraneIcon(Window& window);

// One window at a time: destroying it terminates GLFW.
[[nodiscard]] base::Result<std::unique_ptr<Window>> openGlfwWindow(const WindowOptions& options);

}  // namespace terrane::app
