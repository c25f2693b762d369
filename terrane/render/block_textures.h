// The textures of all block faces as one GPU texture array. Used by the renderer on the context's thread.
//
// Textures may have different sizes. All lie in one array as large as the largest, so that every pass has one
// sampler and one binding, and a draw may mix them. A smaller texture has its own mipmaps from the level of
// its own size downward; the levels above repeat its pixels. The shader computes with the texture's own size
// and reads no level above it, so that a larger texture beside it changes nothing about how it looks.
// An array for each size would save memory, side² × 4 × 4/3 bytes a texture (for the built-in 81: 28 MB at
// 256, 113 MB at 512), but needs a sampler for each size and a branch for each in every fragment: a texture
// may not be chosen by an index that differs within a draw.
#pragma once

#include <cstdint>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gpu/texture.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::render {

using world::TextureSource;

struct BlockTextures {
    gpu::Texture2DArray array;            // layer n is registry.textures()[n]
    std::vector<std::uint8_t> doublings;  // by layer: the array's side is the texture's × 2^n
};

// `maxLayers`: of the graphics driver. Colors stay sRGB bytes, as the G-buffer keeps them: sampling decodes
// nothing, and software renderers have a fast way for such formats. All images must be square, their side a
// power of two; errors name the texture.
base::Result<BlockTextures> loadBlockTextures(const world::BlockRegistry& registry,
                                              const TextureSource& source, int maxLayers);

// The levels of a texture in an array with this side: its mipmaps behind enlarged copies of the largest.
std::vector<base::Image> levelsInArray(std::vector<base::Image> mipmaps, int side);

// What alpha means to a texture's mipmaps. Of several meanings it is one that tests, so that the coverage
// stays, else the last that is used.
world::AlphaMode textureAlpha(const world::BlockRegistry& registry, std::size_t texture);

// What lies beyond a texture's border to its mipmaps: Clamp where a face clamps it.
world::Wrap textureWrap(const world::BlockRegistry& registry, std::size_t texture);

}  // namespace terrane::render
