#include "terrane/world/top_colors.h"

#include "terrane/base/image.h"

namespace terrane::world {
namespace {

glm::vec3 meanColor(const base::Image& image) {
    glm::vec3 sum(0.0f);
    float weight = 0.0f;
    for (std::size_t k = 0; k + 3 < image.rgba.size(); k += 4) {
        if (image.rgba[k + 3] == 0) continue;
        sum += glm::vec3(image.rgba[k], image.rgba[k + 1], image.rgba[k + 2]);
        weight += 1.0f;
    }
    return weight > 0.0f ? sum / weight : sum;
}

}  // namespace

// Alpha that means glow or a share of the tint makes no holes.
base::Result<TopColors> topColors(const BlockRegistry& blocks, const TextureSource& textures) {
    TopColors palette;
    for (const BlockType& type : blocks.types()) {
        if (type.shape == Shape::None) {
            palette.emplace_back();
            continue;
        }
        const Material& material = blocks.materials()[type.material[kFacePosZ]];
        auto image = TERRANE_TRY(textures(blocks.textures()[material.texture]));
        if (material.alpha == AlphaMode::Glow || material.alpha == AlphaMode::Tint) {
            for (std::size_t k = 3; k < image.rgba.size(); k += 4) image.rgba[k] = 255;
        }
        palette.push_back({meanColor(image), material.tinted});
    }
    return palette;
}

}  // namespace terrane::world
