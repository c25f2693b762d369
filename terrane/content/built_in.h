// What is compiled in: block types and textures; for shaders see gpu/built_in_shaders.h.
#pragma once

#include "terrane/base/result.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::content {

base::Result<world::BlockRegistry> loadBlocks();
world::TextureSource builtInTextures();

}  // namespace terrane::content
