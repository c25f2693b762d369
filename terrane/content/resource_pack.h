// Resource packs: a folder of PNG files that replace built-in textures (docs/resource-packs.md).
#pragma once

#include <string>

#include "terrane/base/result.h"
#include "terrane/content/built_in.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::content {

// Pixels per side. 123 textures × 1,024² × 4 bytes × 4/3 for mipmaps = 688 MB on the GPU; 172 MB at side 512.
constexpr int kMaxTextureSide = 1024;

// Returns an error that names `where` unless a texture can have this size: square, its side a power of two up
// to kMaxTextureSide.
base::Result<void> checkTexture(const base::Image& image, const std::string& where);

// Returns all textures of the blocks, each as large as its file. `folder` is the resource pack, or empty for
// none. Missing textures come from `otherwise`. Textures of a content pack are in a folder of its name:
// isles/glow_rock.png. Logs a warning for a file whose name is not a texture. If files cannot be used, the
// result is the error of the last one, and the log has the errors of the others.
base::Result<world::TextureSource> loadTextures(const std::string& folder, const world::BlockRegistry& blocks,
                                                const world::TextureSource& otherwise = builtInTextures());

}  // namespace terrane::content
