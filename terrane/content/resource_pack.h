// Textures of a user's own in place of the built-in ones: a folder of PNG files (docs/resource-packs.md).
#pragma once

#include <string>

#include "terrane/base/result.h"
#include "terrane/content/built_in.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::content {

// Pixels along a side. 33 textures × 1,024² × 4 bytes × 4/3 for mipmaps = 185 MB on the GPU.
constexpr int kMaxTextureSide = 1024;

// An error that names `where` unless a texture can have this size: square, its side a power of two up to
// kMaxTextureSide.
base::Result<void> checkTexture(const base::Image& image, const std::string& where);

// All textures of the blocks, each as large as its file. `folder`: the resource pack; empty for none. What it
// lacks comes from `otherwise`. Textures of a content pack lie in a folder of its name: isles/glow_rock.png.
// Files that are not named as a texture are warned of; of those that cannot be used each is named in a line
// of the log, the last in the result.
base::Result<world::TextureSource> loadTextures(const std::string& folder, const world::BlockRegistry& blocks,
                                                const world::TextureSource& otherwise = builtInTextures());

}  // namespace terrane::content
