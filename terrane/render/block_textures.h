// The textures of all block faces as one GPU texture array. Used by the renderer on the context's thread.
#pragma once

#include "terrane/base/result.h"
#include "terrane/gpu/texture.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::render {

using world::TextureSource;

// Layer n is registry.textures()[n]; `maxLayers`: of the graphics driver. Colors stay sRGB bytes, as the
// G-buffer keeps them: sampling decodes nothing, and software renderers have a fast way for such formats. All
// images must be square, of one size, a power of two; errors name the texture.
base::Result<gpu::Texture2DArray> loadBlockTextures(const world::BlockRegistry& registry,
                                                    const TextureSource& source, int maxLayers);

// What alpha means to a texture's mipmaps. Of several meanings it is one that tests, so that the coverage
// stays, else the last that is used.
world::AlphaMode textureAlpha(const world::BlockRegistry& registry, std::size_t texture);

}  // namespace terrane::render
