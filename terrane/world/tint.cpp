#include "terrane/world/tint.h"

#include <algorithm>

#include "terrane/base/image.h"

namespace terrane::world {

namespace {

// 1/255 at least: a black tint divides by zero for white.
float channelOf(PackedColor color, int shift) {
    return static_cast<float>(std::max(color >> shift & 255u, 1u)) / 255.0f;
}

}  // namespace

glm::vec3 tinted(glm::vec3 color, PackedColor tint) {
    for (int c = 0; c < 3; ++c) {
        const int shift = 16 - 8 * c;
        const float t = channelOf(tint, shift), neutral = channelOf(kNeutralTint, shift);
        color[c] = color[c] * t / (t + (1.0f - color[c]) * (neutral - t) / (1.0f - neutral));
    }
    return color;
}

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

namespace {

bool isSurface(const BlockType& type) {
    return type.shape != Shape::None && type.shape != Shape::Cross && type.shape != Shape::Hash;
}

bool isEmpty(const Section& section, const BlockRegistry& blocks) {
    return section.isUniform() && !isSurface(blocks.type(section.uniformValue()));
}

}  // namespace

LandTile landTileOf(const Chunk& chunk, const BlockRegistry& blocks) {
    const Heights heights = chunk.heights();
    int highest = heights.endSection() - 1;
    while (highest > heights.firstSection() && isEmpty(chunk.section(highest), blocks)) --highest;
    LandTile tile;
    tile.height.fill(static_cast<std::int16_t>(heights.bottom));
    for (std::size_t k = 0; k < LandTile::kColumns; ++k) {
        for (int z = kSectionSize * (highest + 1); z-- > heights.bottom;) {
            const BlockId id = chunk.block(static_cast<int>(k) | z << 8);
            if (!isSurface(blocks.type(id))) continue;
            tile.height[k] = static_cast<std::int16_t>(z + 1);
            tile.ground[k] = id;
            break;
        }
    }
    return tile;
}

}  // namespace terrane::world
