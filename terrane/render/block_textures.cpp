#include "terrane/render/block_textures.h"

#include "terrane/render/mipmaps.h"

namespace terrane::render {
namespace {

// A texture used with several meanings of alpha keeps the coverage of the one that tests it.
world::AlphaMode alphaOf(const world::BlockRegistry& registry, std::size_t texture) {
    world::AlphaMode alpha = world::AlphaMode::Unused;
    for (const world::Material& material : registry.materials()) {
        if (material.texture == texture && material.alpha != world::AlphaMode::Unused) alpha = material.alpha;
    }
    return alpha;
}

}  // namespace

base::Result<gpu::Texture2DArray> loadBlockTextures(const world::BlockRegistry& registry,
                                                    const TextureSource& source) {
    const auto names = registry.textures();
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
            array = gpu::Texture2DArray({size, static_cast<int>(names.size()), gpu::fullLevels(size)},
                                        GL_RGBA8, "block textures");
        }
        if (image->width != size.x) {
            return base::fail("texture \"{}\": is {} wide, the others are {}", names[layer], image->width,
                              size.x);
        }
        const auto levels = mipmaps(*image, alphaOf(registry, layer));
        for (std::size_t level = 0; level < levels.size(); ++level) {
            array.upload(static_cast<int>(level), static_cast<int>(layer), GL_RGBA, GL_UNSIGNED_BYTE,
                         std::as_bytes(std::span(levels[level].rgba)));
        }
    }
    return array;
}

}  // namespace terrane::render
