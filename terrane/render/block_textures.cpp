#include "terrane/render/block_textures.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <span>

#include "terrane/render/mipmaps.h"
#include "terrane/shared/material.h"

namespace terrane::render {
namespace {

// Enlarges an image: each pixel becomes a square of pixels.
base::Image enlarged(const base::Image& image, int side) {
    const int factor = side / image.width;
    base::Image large{
        side, side,
        std::vector<std::uint8_t>(4 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side))};
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const auto from = 4 * static_cast<std::ptrdiff_t>(y / factor * image.width + x / factor);
            const auto to = 4 * (static_cast<std::ptrdiff_t>(y) * side + x);
            std::copy_n(image.rgba.begin() + from, 4, large.rgba.begin() + to);
        }
    }
    return large;
}

base::Result<std::vector<base::Image>> readImages(std::span<const std::string> names,
                                                  const TextureSource& source) {
    std::vector<base::Image> images;
    for (const std::string& name : names) {
        base::Image image = TERRANE_TRY(source(name));
        if (image.width != image.height || !std::has_single_bit(static_cast<unsigned>(image.width))) {
            return base::fail("texture \"{}\": {}×{} is not square with a power of two", name, image.width,
                              image.height);
        }
        images.push_back(std::move(image));
    }
    return images;
}

}  // namespace

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

world::Wrap textureWrap(const world::BlockRegistry& registry, std::size_t texture) {
    const bool isClamped = std::ranges::any_of(registry.materials(), [&](const world::Material& material) {
        return material.texture == texture && material.wrap == world::Wrap::Clamp;
    });
    return isClamped ? world::Wrap::Clamp : world::Wrap::Quad;
}

std::vector<base::Image> levelsInArray(std::vector<base::Image> mipmaps, int side) {
    const base::Image largest = mipmaps.front();
    std::vector<base::Image> levels;
    for (; side > largest.width; side /= 2) levels.push_back(enlarged(largest, side));
    std::ranges::move(mipmaps, std::back_inserter(levels));
    return levels;
}

base::Result<BlockTextures> loadBlockTextures(const world::BlockRegistry& registry,
                                              const TextureSource& source, const TextureLimits& limits) {
    const auto names = registry.textures();
    const int count = static_cast<int>(names.size());
    const int most = std::min(static_cast<int>(shared::kMaxBlockTextures), limits.layers);
    if (count > most) return base::fail("the blocks have {} textures: at most {} can be drawn", count, most);
    const auto images = TERRANE_TRY(readImages(names, source));
    const int largest = std::ranges::max(images, {}, &base::Image::width).width;
    const int side = std::min(largest, limits.side);
    BlockTextures textures;
    textures.array =
        gpu::Texture2DArray({{side, side}, count, gpu::fullLevels({side, side})}, GL_RGBA8, "block textures");
    for (std::size_t layer = 0; layer < images.size(); ++layer) {
        auto mips = mipmaps(images[layer], textureAlpha(registry, layer), textureWrap(registry, layer));
        std::erase_if(mips, [&](const base::Image& mip) { return mip.width > side; });
        const auto times = static_cast<unsigned>(side / mips.front().width);
        const auto levels = levelsInArray(std::move(mips), side);
        for (std::size_t level = 0; level < levels.size(); ++level) {
            textures.array.upload(static_cast<int>(level), static_cast<int>(layer), GL_RGBA, GL_UNSIGNED_BYTE,
                                  std::as_bytes(std::span(levels[level].rgba)));
        }
        textures.doublings.push_back(static_cast<std::uint8_t>(std::countr_zero(times)));
    }
    return textures;
}

}  // namespace terrane::render
