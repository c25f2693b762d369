// Mipmaps of block textures that keep the look of the full size. Pure functions, any thread.
#pragma once

#include <vector>

#include "terrane/base/image.h"
#include "terrane/world/block_type.h"

namespace terrane::render {

// Level 0 is the image, except that texels hidden by a tested alpha take the colors around them; each next
// level is half as large, down to 1×1. The image is square, its side a power of two.
//
// Colors are averaged as light (sRGB is decoded), weighted by alpha if alpha is coverage. If alpha decides
// holes, each level is scaled so that the share of the surface that passes the test is that of level 0;
// otherwise leaves and grass would thin out with distance (I. Castaño, Computing Alpha Mipmaps, 2010). Beyond
// its border a texture repeats, except with Wrap::Clamp, where its border is extended.
std::vector<base::Image> mipmaps(const base::Image& image, world::AlphaMode alpha,
                                 world::Wrap wrap = world::Wrap::Quad);

}  // namespace terrane::render
