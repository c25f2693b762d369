#include "terrane/render/mipmaps.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace terrane::render {
namespace {

// Linear colours, alpha as stored.
struct LinearImage {
    int size = 0;
    std::vector<glm::vec4> texels;
};

float decodeSrgb(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}
float encodeSrgb(float v) {
    return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

LinearImage decode(const base::Image& image) {
    LinearImage result{image.width, {}};
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
    const auto byte = [](float v) {
        return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
    };
    for (const glm::vec4& t : linear.texels) {
        for (int c = 0; c < 3; ++c) image.rgba.push_back(byte(encodeSrgb(t[c])));
        image.rgba.push_back(byte(t.a * alphaScale));
    }
    return image;
}

LinearImage half(const LinearImage& from, bool alphaIsCoverage) {
    LinearImage to{from.size / 2, {}};
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
            // Texels hidden on all sides keep their colour: filters reach them.
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

float coverage(const LinearImage& image, float limit) {
    const auto passes = [&](const glm::vec4& t) { return t.a >= limit; };
    const auto count = std::count_if(image.texels.begin(), image.texels.end(), passes);
    return static_cast<float>(count) / static_cast<float>(image.texels.size());
}

// The factor on alpha that lets the wanted share of texels pass: from the alpha of the texel at that rank.
float coverageScale(const LinearImage& image, float wanted, float limit) {
    std::vector<float> alphas;
    for (const glm::vec4& t : image.texels) alphas.push_back(t.a);
    std::sort(alphas.begin(), alphas.end(), std::greater<>());
    const auto count = static_cast<std::size_t>(std::lround(wanted * static_cast<float>(alphas.size())));
    if (count == 0) return 1.0f;
    const float last = alphas[count - 1];
    return last > 0.0f ? (limit + 0.01f) / last : 1.0f;
}

}  // namespace

std::vector<base::Image> mipmaps(const base::Image& image, world::AlphaMode alpha) {
    assert(image.width == image.height && (image.width & (image.width - 1)) == 0 &&
           "block textures are 2^n square");
    const bool isTested = alpha == world::AlphaMode::Test || alpha == world::AlphaMode::TestGlow;
    std::vector<base::Image> levels{image};
    LinearImage level = decode(image);
    const float limit = threshold(alpha), wanted = coverage(level, limit);
    while (level.size > 1) {
        level = half(level, isTested || alpha == world::AlphaMode::Blend);
        levels.push_back(encode(level, isTested ? coverageScale(level, wanted, limit) : 1.0f));
    }
    return levels;
}

}  // namespace terrane::render
