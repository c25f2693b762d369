// The textures of all block faces as one GPU texture array. The renderer uses it on the context's thread.
//
// Textures may have different sizes. All lie in one array as large as the largest, so every pass has one
// sampler and one binding, and a draw may mix them. A smaller texture has its own mipmaps from the level of
// its own size downward; the levels above repeat its pixels. The shader computes with the texture's own size
// and reads no level above it, so a larger texture in the array does not change its appearance.
//
// Memory: side² × 4 bytes × 4/3 for mipmaps = side² × 16/3 bytes per texture. The 123 built-in textures take
// 43 MB at side 256, 172 MB at 512, 688 MB at 1,024. One array per size would save memory, but needs one
// sampler per size and a branch for each in every fragment: GLSL forbids sampler indices that differ within
// a draw.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/base/srgb.h"
#include "terrane/gpu/texture.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/blocks/block_type.h"

namespace terrane::render {

using base::decodeSrgb, base::encodeSrgb;

// Returns mipmaps that preserve the appearance of the full size. Level 0 is the image, except that texels
// hidden by a tested alpha take the colors around them; each next level is half as large, down to 1×1. The
// image is square, its side a power of two.
//
// Colors are averaged as light (sRGB is decoded), weighted by alpha if alpha is coverage. If alpha decides
// holes, each level is scaled so that the share of the surface that passes the test is that of level 0;
// otherwise leaves and grass would thin out with distance (I. Castaño, Computing Alpha Mipmaps, 2010). Beyond
// its border a texture repeats, except with Wrap::Clamp, where its border is extended.
std::vector<base::Image> mipmaps(const base::Image& image, world::AlphaMode alpha,
                                 world::Wrap wrap = world::Wrap::Quad);

using world::TextureSource;

struct BlockTextures {
    gpu::Texture2DArray array;              // layer n is registry.textures()[n]
    std::vector<std::uint8_t> doublings;    // by layer: the array's side is the texture's × 2^n
    std::vector<std::uint32_t> meanColors;  // by layer, as in shared::MaterialRecord
};

// Of the array. A texture with a larger side loses its largest mipmaps.
struct TextureLimits {
    int layers = 0;  // of the graphics driver
    int side = std::numeric_limits<int>::max();
};

// Loads the textures. Colors stay sRGB bytes, as in the G-buffer: sampling does not decode them, and software
// renderers have a fast path for such formats. All images must be square with a side that is a power of two;
// errors name the texture.
base::Result<BlockTextures> loadBlockTextures(const world::BlockRegistry& registry,
                                              const TextureSource& source, const TextureLimits& limits);

// Returns the levels of a texture in an array with this side: its mipmaps behind enlarged copies of the
// largest.
std::vector<base::Image> levelsInArray(std::vector<base::Image> mipmaps, int side);

// Returns the meaning of alpha for the mipmaps of a texture. If materials disagree, an alpha test wins, so
// mipmaps keep the coverage; otherwise the last material wins.
world::AlphaMode textureAlpha(const world::BlockRegistry& registry, std::size_t texture);

// Returns the wrap mode for the mipmaps of a texture: Clamp if a face clamps it.
world::Wrap textureWrap(const world::BlockRegistry& registry, std::size_t texture);

}  // namespace terrane::render
