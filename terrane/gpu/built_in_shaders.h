// The shaders that are compiled into the program.
#pragma once

#include <string>

#include "terrane/gpu/shader_loader.h"

namespace terrane::gpu {

// `shaderRoot`: a source tree whose shaders take precedence over the built-in ones; empty for none.
ShaderLoader builtInShaders(const std::string& shaderRoot);

}  // namespace terrane::gpu
