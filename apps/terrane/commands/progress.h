// The progress bar of a long command, which a signal stops.
#pragma once

#include <string>

#include "terrane/io/world_options.h"

namespace terrane::app {

// Draws a bar from its first call on. Until it is destroyed, signals stop the run instead of the program.
io::Progress progressBar(std::string what);

}  // namespace terrane::app
