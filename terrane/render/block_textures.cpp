#include "terrane/render/block_textures.h"

#include <algorithm>

#include "terrane/render/mipmaps.h"
#include "terrane/shared/material.h"

namespace terrane::render {

world::AlphaMode textureAlpha(const world::BlockRegistry& registry, std::size_t texture) {
    using world::AlphaMode;
    AlphaMode alpha = AlphaMode::Unused;
    for (const world::Material& material : registry.materials()) {
        if (material.texture != texture || material.alpha == AlphaMode::Unused) continue;
        alpha = material.alpha;
        if (alpha == AlphaMode::Test || alpha == AlphaMode::TestGlow) return alpha;
    }
    return alpha;
}

base::Result<gpu::Texture2DArray> loadBlockTextures(const world::BlockRegistry& registry,
                                                    const TextureSource& source, int maxLayers) {
    const auto names = registry.textures();
    const int count = static_cast<int>(names.size());
    const int most = std::min(static_cast<int>(shared::kMaxBlockTextures), maxLayers);
    if (count > most) return base::fail("the blocks have {} textures: at most {} can be drawn", count, most);
    gpu::Texture2DArray array;
    glm::ivec2 size{0};
    for (std::size_t layer = 0; layer < names.size(); ++layer) {
        const base::Result<base::Image> image = source(names[layer]);
        if (!image) return tl::unexpected(image.error());
        const bool isPowerOfTwo = image->width > 0 && (image->width & (image->width - 1)) == 0;
        if (image->width != image->height || !isPowerOfTwo) {
            return base::fail("texture \"{}\": {}×{} is not square with a power of two", names[layer],
                              image->width, image->height);
        }
        if (layer == 0) {
            size = {image->width, image->height};
            array = gpu::Texture2DArray({size, count, gpu::fullLevels(size)}, GL_RGBA8, "block textures");
        }
        if (image->width != size.x) {
            return base::fail("texture \"{}\": is {} wide, the others are {}", names[layer], image->width,
                              size.x);
        }
        const auto levels = mipmaps(*image, textureAlpha(registry, layer));
        for (std::size_t level = 0; level < levels.size(); ++level) {
            array.upload(static_cast<int>(level), static_cast<int>(layer), GL_RGBA, GL_UNSIGNED_BYTE,
                         std::as_bytes(std::span(levels[level].rgba)));
        }
    }
    return array;
}

}  // namespace terrane::render
