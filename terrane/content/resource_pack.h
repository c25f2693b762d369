// Textures of a user's own in place of the built-in ones: a folder of PNG files (docs/resource-packs.md).
#pragma once

#include <string>

#include "terrane/base/result.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::content {

// Pixels along a side. 33 textures × 1,024² × 4 bytes × 4/3 for mipmaps = 185 MB on the GPU.
constexpr int kMaxTextureSide = 1024;

// All textures of the blocks, each as large as its file. `folder`: the pack; empty for none. Files that are
// not named as a texture are warned of; of those that cannot be used each is named in a line of the log, the
// last in the result.
base::Result<world::TextureSource> loadTextures(const std::string& folder,
                                                const world::BlockRegistry& blocks);

}  // namespace terrane::content
