// Writes a pass as the body of a GLSL compute shader: the second back end of the expression graph. The text
// is complete with the helper functions of gen_gpu/*.glsl, which define the inputs and outputs. Any thread
// may use it.
#pragma once

#include <string>

#include "terrane/gen/compile/generator_graph.h"

namespace terrane::gen {

// Returns the text. One invocation computes a column; 3D passes go through a range of z. Values are named
// v<node>.
std::string emitGlsl(const GeneratorGraph& generator, std::size_t pass);

}  // namespace terrane::gen
