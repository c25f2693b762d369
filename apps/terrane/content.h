// What is compiled into the program: block types, textures, shaders.
#pragma once

#include "terrane/base/result.h"
#include "terrane/gpu/shader_loader.h"
#include "terrane/render/block_textures.h"
#include "terrane/world/block_registry.h"

namespace terrane::app {

base::Result<world::BlockRegistry> loadBlocks();
render::TextureSource builtInTextures();
// `shaderRoot`: a source tree whose shaders come before the built-in ones; empty for none.
gpu::ShaderLoader makeShaderLoader(const std::string& shaderRoot);

}  // namespace terrane::app
