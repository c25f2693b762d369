#include "terrane/formats/vox_blocks.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

namespace terrane::formats {
namespace {

// sRGB to linear, IEC 61966-2-1.
float linear(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

// B. Ottosson, "A perceptual color space for image processing" (2020). `srgb` is 0…255.
glm::vec3 oklabOf(glm::vec3 srgb) {
    const float r = linear(srgb.x / 255), g = linear(srgb.y / 255), b = linear(srgb.z / 255);
    const float l = std::cbrt(0.4122214708f * r + 0.5363325363f * g + 0.0514459929f * b);
    const float m = std::cbrt(0.2119034982f * r + 0.6806995451f * g + 0.1073969566f * b);
    const float s = std::cbrt(0.0883024619f * r + 0.2817188376f * g + 0.6299787005f * b);
    return {0.2104542553f * l + 0.7936177850f * m - 0.0040720468f * s,
            1.9779984951f * l - 2.4285922050f * m + 0.4505937099f * s,
            0.0259040371f * l + 0.7827717662f * m - 0.8086757660f * s};
}

glm::vec3 channelsOf(std::uint32_t color) {
    return {color >> 16 & 255, color >> 8 & 255, color & 255};
}

std::uint32_t colorOf(glm::vec3 mean) {
    const auto channel = [](float value) { return static_cast<std::uint32_t>(std::lround(value)); };
    return channel(mean.x) << 16 | channel(mean.y) << 8 | channel(mean.z);
}

}  // namespace

world::BlockId nearestCube(std::uint32_t color, const world::BlockRegistry& blocks,
                           const world::TopColors& tops) {
    const glm::vec3 wanted = oklabOf(channelsOf(color));
    world::BlockId nearest = blocks.missing();
    float least = INFINITY;
    for (const world::BlockType& type : blocks.types()) {
        if (!type.opaqueCube || type.id == blocks.missing() || tops[type.id].tinted) continue;
        const glm::vec3 away = oklabOf(tops[type.id].mean) - wanted;
        const float distance = glm::dot(away, away);
        if (distance >= least) continue;
        least = distance;
        nearest = type.id;
    }
    return nearest;
}

BlockVolume toBlocks(const VoxImage& image, const BlockMapping& mapping, const world::BlockRegistry& blocks,
                     const world::TopColors& tops) {
    BlockVolume volume{image.size, {}, {image.cells.begin(), image.cells.end()}};
    std::vector<bool> isUsed(image.colors.size());
    for (const std::uint8_t cell : image.cells) isUsed[cell] = true;
    volume.palette.resize(image.colors.size());
    for (std::size_t k = 1; k < image.colors.size(); ++k) {
        if (!isUsed[k]) continue;
        const std::uint32_t color = image.colors[k] >> 8;
        const auto named = mapping.colors().find(color);
        const bool isNamed = named != mapping.colors().end();
        volume.palette[k].id = isNamed ? named->second : nearestCube(color, blocks, tops);
    }
    return volume;
}

base::Result<VoxImage> toVox(const BlockVolume& volume, const world::TopColors& tops) {
    VoxImage image;
    image.size = volume.size;
    std::unordered_map<std::uint32_t, std::uint8_t> numbers;
    std::vector<std::int16_t> numberOf(volume.palette.size(), -1);
    image.cells.reserve(volume.cells.size());
    for (const std::uint16_t cell : volume.cells) {
        std::int16_t& number = numberOf[cell];
        const world::BlockId id = volume.palette[cell].id;
        if (number < 0 && id == world::kAir) number = 0;
        if (number < 0) {
            const std::uint32_t color = colorOf(tops[id < tops.size() ? id : 0].mean);
            const auto [place, isNew] = numbers.emplace(color, static_cast<std::uint8_t>(numbers.size() + 1));
            if (numbers.size() > 255) return base::fail("the blocks have more than 255 colors");
            number = place->second;
            if (isNew) image.colors[place->second] = color << 8 | 0xff;
        }
        image.cells.push_back(static_cast<std::uint8_t>(number));
    }
    return image;
}

}  // namespace terrane::formats
