// Shows the error that ends the program, for a player who started it by its icon and sees no terminal.
// Used on the program's main thread.
#pragma once

#include <string>

#include "apps/terrane/window/text.h"
#include "apps/terrane/window/window.h"

namespace terrane::app {

// Whether somebody reads what the program writes to standard error: it is a terminal or a pipe, or the
// program was started from a terminal. Desktops connect it to their log or to nothing.
bool isStandardErrorRead();

// A window for the error. Every driver with OpenGL 3.2 can show it, also one that cannot show a world.
WindowOptions errorWindowOptions();

// Returns when the player closes the window or a signal ends the program.
void showError(Window& window, const std::string& error, const Texts& tr);

}  // namespace terrane::app
