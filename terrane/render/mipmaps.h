// Smaller copies of block textures that keep the look of the large ones. Pure functions, any thread.
#pragma once

#include <vector>

#include "terrane/base/image.h"
#include "terrane/world/block_type.h"

namespace terrane::render {

// Level 0 is the image, but that texels hidden by a tested alpha take the colors around them; each next one
// half as large, down to 1×1. The image is square, its side a power of two.
//
// Colors are averaged as light (sRGB is decoded), weighted by alpha where alpha is coverage. Where alpha
// decides holes, each level is scaled so that the share of the surface that passes the test stays that of
// level 0: else leaves and grass would thin out with distance (I. Castaño, Computing Alpha Mipmaps, 2010).
// Beyond its border a texture repeats, but with Wrap::Clamp, where its border goes on.
std::vector<base::Image> mipmaps(const base::Image& image, world::AlphaMode alpha,
                                 world::Wrap wrap = world::Wrap::Quad);

}  // namespace terrane::render
