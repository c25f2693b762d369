#include "terrane/map/map_colors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "terrane/world/top_colors.h"

namespace terrane::map {
namespace {

using Texels = std::array<glm::vec3, kTexels * kTexels>;

// Each texel is the mean of a square of the texture. Holes count as the mean of the whole.
Texels texelsOf(const base::Image& texture, const glm::vec3& mean) {
    Texels texels;
    for (int k = 0; k < kTexels * kTexels; ++k) {
        const int x0 = k % kTexels * texture.width / kTexels,
                  x1 = (k % kTexels + 1) * texture.width / kTexels;
        const int y0 = k / kTexels * texture.width / kTexels,
                  y1 = (k / kTexels + 1) * texture.width / kTexels;
        glm::vec3 sum(0);
        float count = 0;
        for (int y = y0; y < std::min(y1, texture.height); ++y) {
            for (int x = x0; x < x1; ++x) {
                const auto* pixel = &texture.rgba[static_cast<std::size_t>(y * texture.width + x) * 4];
                sum += pixel[3] == 0 ? mean : glm::vec3(pixel[0], pixel[1], pixel[2]) / 255.0f;
                ++count;
            }
        }
        texels[static_cast<std::size_t>(k)] = (count > 0 ? sum / count : mean) / glm::max(mean, 1.0f / 255);
    }
    return texels;
}

// A source that reads each texture once. Refers to `source`.
world::TextureSource readingOnce(const world::TextureSource& source) {
    auto images = std::make_shared<std::map<std::string, base::Image, std::less<>>>();
    return [&source, images](std::string_view name) -> base::Result<base::Image> {
        const auto found = images->find(name);
        if (found != images->end()) return found->second;
        auto image = source(name);
        if (image) images->emplace(name, *image);
        return image;
    };
}

}  // namespace

glm::vec3 throughLiquid(const glm::vec3& liquid, const glm::vec3& ground, float depthBlocks) {
    constexpr float kDark = 14, kHidden = 5.6f;  // blocks
    const glm::vec3 water = liquid * (0.6f + 0.4f * std::exp(-depthBlocks / kDark));
    return glm::mix(water, ground, 0.5f * std::exp(-depthBlocks / kHidden));
}

glm::vec3 colorOfLiquid(const BlockColor& block, const glm::vec3& liquid, const glm::vec3& ground,
                        float depthBlocks) {
    return block.reach > 0 ? liquid : throughLiquid(liquid, ground, depthBlocks);
}

base::Result<MapColors> mapColors(const world::BlockRegistry& blocks, const world::TextureSource& source) {
    const world::TextureSource textures = readingOnce(source);
    const auto tops = TERRANE_TRY(world::topColors(blocks, textures));
    const SurfaceKinds kinds = surfaceKinds(blocks);
    MapColors colors;
    for (const world::BlockType& type : blocks.types()) {
        const world::TopColor& top = tops[type.id];
        BlockColor color{.mean = top.mean / 255.0f, .isTinted = top.tinted, .kind = kinds[type.id]};
        const auto brightest = *std::ranges::max_element(type.emission);
        color.emission = glm::vec3(type.emission[0], type.emission[1], type.emission[2]) / 15.0f;
        color.reach = static_cast<float>(brightest);
        if (type.shape != world::Shape::None) {
            const auto& material = blocks.materials()[type.material[world::kFacePosZ]];
            const auto texture = TERRANE_TRY(textures(blocks.textures()[material.texture]));
            color.texels = texelsOf(texture, color.mean);
        }
        colors.push_back(color);
    }
    return colors;
}

}  // namespace terrane::map
