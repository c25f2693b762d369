#include "terrane/render/quads/block_textures.h"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "terrane/shared/material.h"

namespace terrane::render {

namespace {

// Linear colors, alpha as stored.
struct LinearImage {
    int size = 0;
    world::Wrap wrap = world::Wrap::Quad;
    std::vector<glm::vec4> texels;
};

std::uint8_t byte(float v) {
    return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
}

LinearImage decode(const base::Image& image, world::Wrap wrap) {
    LinearImage result{image.width, wrap, {}};
    for (std::size_t k = 0; k < image.rgba.size(); k += 4) {
        const auto channel = [&](std::size_t c) { return static_cast<float>(image.rgba[k + c]) / 255.0f; };
        result.texels.emplace_back(decodeSrgb(channel(0)), decodeSrgb(channel(1)), decodeSrgb(channel(2)),
                                   channel(3));
    }
    return result;
}

base::Image encode(const LinearImage& linear, float alphaScale) {
    base::Image image;
    image.width = image.height = linear.size;
    for (const glm::vec4& t : linear.texels) {
        for (int c = 0; c < 3; ++c) image.rgba.push_back(byte(encodeSrgb(t[c])));
        image.rgba.push_back(byte(t.a * alphaScale));
    }
    return image;
}

LinearImage half(const LinearImage& from, bool alphaIsCoverage) {
    LinearImage to{from.size / 2, from.wrap, {}};
    for (int y = 0; y < to.size; ++y) {
        for (int x = 0; x < to.size; ++x) {
            glm::vec4 sum(0.0f), plain(0.0f);
            float weight = 0.0f;
            for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
                const glm::vec4 t =
                    from.texels[static_cast<std::size_t>((2 * y + dy) * from.size + 2 * x + dx)];
                const float w = alphaIsCoverage ? t.a : 1.0f;
                sum += t * w;
                plain += t;
                weight += w;
            }
            // Texels hidden on all sides keep their color: filters reach them.
            glm::vec4 mean = weight > 0.0f ? sum / weight : plain * 0.25f;
            mean.a = plain.a * 0.25f;
            to.texels.push_back(mean);
        }
    }
    return to;
}

float threshold(world::AlphaMode alpha) {
    return alpha == world::AlphaMode::TestGlow ? 0.25f : 0.5f;
}

// Texel used for one beyond the border; sizes are powers of two.
int insideOf(int texel, int size, world::Wrap wrap) {
    return wrap == world::Wrap::Clamp ? std::clamp(texel, 0, size - 1) : texel & (size - 1);
}

// Alpha as stored, filtered between texels; x and y in texels from the middle of the first.
float filteredAlpha(const LinearImage& image, float x, float y, float scale) {
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const auto alpha = [&](int tx, int ty) {
        const auto at = static_cast<std::size_t>(insideOf(ty, image.size, image.wrap) * image.size +
                                                 insideOf(tx, image.size, image.wrap));
        return static_cast<float>(byte(image.texels[at].a * scale)) / 255.0f;
    };
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    return glm::mix(glm::mix(alpha(x0, y0), alpha(x0 + 1, y0), fx),
                    glm::mix(alpha(x0, y0 + 1), alpha(x0 + 1, y0 + 1), fx), fy);
}

// Share of the surface that passes the alpha test with alpha scaled and filtered, as it is drawn.
float coverage(const LinearImage& image, float limit, float scale) {
    constexpr int kSamplesPerTexel = 4;  // along each side
    const int side = kSamplesPerTexel * image.size;
    const auto place = [](int sample) {
        return (static_cast<float>(sample) + 0.5f) / kSamplesPerTexel - 0.5f;
    };
    int passed = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) passed += filteredAlpha(image, place(x), place(y), scale) >= limit;
    }
    return static_cast<float>(passed) / static_cast<float>(side * side);
}

// Factor on alpha whose coverage is nearest to `wanted`; 1 if none is better.
float coverageScale(const LinearImage& image, float limit, float wanted) {
    const float unscaled = coverage(image, limit, 1.0f);
    float low = unscaled < wanted ? 1.0f : 0.0f, high = unscaled < wanted ? 16.0f : 1.0f;
    for (int step = 0; step < 16; ++step) {
        const float middle = (low + high) / 2;
        (coverage(image, limit, middle) < wanted ? low : high) = middle;
    }
    const float below = coverage(image, limit, low), above = coverage(image, limit, high);
    const bool takesAbove = above - wanted < wanted - below;
    if ((takesAbove ? above : below) == unscaled) return 1.0f;
    return takesAbove ? high : low;
}

// A texel and its neighbors; some occur twice if the texture does not repeat.
std::array<std::size_t, 9> texelsAround(const base::Image& image, world::Wrap wrap, std::size_t at) {
    const int size = image.width, x = static_cast<int>(at) % size, y = static_cast<int>(at) / size;
    std::array<std::size_t, 9> texels{};
    for (int k = 0; k < 9; ++k) {
        const int nx = insideOf(x + k % 3 - 1, size, wrap), ny = insideOf(y + k / 3 - 1, size, wrap);
        texels[static_cast<std::size_t>(k)] = static_cast<std::size_t>(ny * size + nx);
    }
    return texels;
}

// Sets a texel to the mean of the known colors around it, with alpha 0. At least one is known.
void takeColorAround(base::Image& image, world::Wrap wrap, const std::vector<bool>& known, std::size_t at) {
    std::array<int, 3> sum{};
    int count = 0;
    for (const std::size_t texel : texelsAround(image, wrap, at)) {
        if (!known[texel]) continue;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += image.rgba[4 * texel + c];
        ++count;
    }
    for (std::size_t c = 0; c < 3; ++c) image.rgba[4 * at + c] = static_cast<std::uint8_t>(sum[c] / count);
    image.rgba[4 * at + 3] = 0;
}

// Gives hidden texels the color of their neighbors, ring by ring, since filters mix them into the edges.
void colorHiddenTexels(base::Image& image, world::Wrap wrap) {
    std::vector<bool> known;
    for (std::size_t k = 3; k < image.rgba.size(); k += 4) known.push_back(image.rgba[k] > 0);
    std::vector<bool> isInRing = known;  // this one or one before
    std::vector<std::size_t> ring;
    const auto addAround = [&](std::size_t at) {
        for (const std::size_t texel : texelsAround(image, wrap, at)) {
            if (isInRing[texel]) continue;
            isInRing[texel] = true;
            ring.push_back(texel);
        }
    };
    for (std::size_t at = 0; at < known.size(); ++at)
        if (known[at]) addAround(at);
    while (!ring.empty()) {
        for (const std::size_t at : ring) takeColorAround(image, wrap, known, at);
        for (const std::size_t at : ring) known[at] = true;
        for (const std::size_t at : std::exchange(ring, {})) addAround(at);
    }
}

}  // namespace

std::vector<base::Image> mipmaps(const base::Image& image, world::AlphaMode alpha, world::Wrap wrap) {
    assert(image.width == image.height && (image.width & (image.width - 1)) == 0 &&
           "block textures are 2^n square");
    const bool isTested = alpha == world::AlphaMode::Test || alpha == world::AlphaMode::TestGlow;
    std::vector<base::Image> levels{image};
    if (isTested) colorHiddenTexels(levels[0], wrap);
    LinearImage level = decode(levels[0], wrap);
    const float limit = threshold(alpha), wanted = coverage(level, limit, 1.0f);
    while (level.size > 1) {
        level = half(level, isTested || alpha == world::AlphaMode::Blend);
        levels.push_back(encode(level, isTested ? coverageScale(level, limit, wanted) : 1.0f));
    }
    return levels;
}

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
        const std::span<const std::uint8_t> mean = mips.back().rgba;  // of one pixel
        textures.meanColors.push_back(mean[0] | std::uint32_t{mean[1]} << 8 | std::uint32_t{mean[2]} << 16);
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
