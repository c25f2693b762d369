// The shaders that are compiled into the program.
#pragma once

#include <string>

#include "terrane/gpu/shader_loader.h"

namespace terrane::app {

// `shaderRoot`: a source tree whose shaders come before the built-in ones; empty for none.
gpu::ShaderLoader makeShaderLoader(const std::string& shaderRoot);

}  // namespace terrane::app
