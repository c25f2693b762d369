// Bounds the time that a chunk of a recorded generator takes. script.cpp checks each script's. Any thread.
#pragma once

#include <string>

#include "terrane/gen/generator_graph.h"

namespace terrane::lua {

// Returns the reason if a chunk may take too long, else an empty string. The graph has no mistakes. Stamps
// count once it has its table of shapes.
std::string unboundedWork(const gen::GeneratorGraph& graph);

}  // namespace terrane::lua
