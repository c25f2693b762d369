#include "terrane/map/paint.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "terrane/world/tint.h"

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

namespace {

using world::BlockId;

// Light comes from the northwest, as on most maps: image coordinates, x to the right, y down, z up.
constexpr glm::vec3 kLight(-0.50f, -0.58f, 0.64f);
// Slope of a rise of one block on the finest map. Wider columns are shown steeper, so that relief is visible
// at every zoom.
constexpr float kRelief = 0.6f, kReliefOfLevel = 1.45f;
// Relief is the slope of the land around, and for this share the step beside a column: steps show buildings,
// slopes the shape of hills.
constexpr float kStepShare = 0.35f;
constexpr float kSkyShare = 0.32f;  // of the light on flat ground: the sky's, which has no direction
constexpr glm::vec3 kNight(0.30f, 0.34f, 0.48f);
constexpr float kLampShare = 1.1f;  // of the color by day, beside a lamp

// Colors of tinted blocks at the samples of the tint, computed when a block is first used.
class TintedColors {
  public:
    TintedColors(const PaintedArea& area, const MapColors& colors) : area_(area), colors_(colors) {}

    // The color in a column, x and y from the area's corner.
    glm::vec3 at(BlockId block, int x, int y) {
        const BlockColor& color = colors_[block];
        if (!color.isTinted) return color.mean;
        const std::vector<glm::vec3>& samples = samplesOf(block);
        const TintField& tint = area_.tint;
        const float u = static_cast<float>(area_.surfaces.rect.x0 + x - tint.x0) / TintField::kStep;
        const float v = static_cast<float>(area_.surfaces.rect.y0 + y - tint.y0) / TintField::kStep;
        const int i = static_cast<int>(u), j = static_cast<int>(v);
        const auto sample = [&](int di, int dj) {
            return samples[static_cast<std::size_t>((j + dj) * tint.width + i + di)];
        };
        const float s = u - static_cast<float>(i), t = v - static_cast<float>(j);
        return glm::mix(glm::mix(sample(0, 0), sample(1, 0), s), glm::mix(sample(0, 1), sample(1, 1), s), t);
    }

  private:
    const std::vector<glm::vec3>& samplesOf(BlockId block) {
        auto& samples = samples_[block];
        if (samples.empty())
            for (const world::PackedColor tint : area_.tint.samples)
                samples.push_back(world::tinted(colors_[block].mean, tint));
        return samples;
    }

    const PaintedArea& area_;
    const MapColors& colors_;
    std::unordered_map<BlockId, std::vector<glm::vec3>> samples_;
};

bool isLiquid(const MapColors& colors, BlockId block) {
    return block < colors.size() && colors[block].kind == SurfaceKind::Liquid;
}

// The height for relief: of the ground under a liquid, else of the top.
float reliefHeight(const MapColors& colors, const SurfaceColumn& column) {
    return static_cast<float>(isLiquid(colors, column.top) ? column.underZ : column.topZ);
}

// The brightness of ground that rises by `rise` toward the right and downward, blocks a block.
float lightOn(glm::vec2 rise) {
    const glm::vec3 normal = glm::normalize(glm::vec3(-rise, 1.0f));
    // Half Lambert (Mitchell, McTaggart and Green, "Shading in Valve's Source Engine", 2006): slopes that are
    // turned away keep their shape. Flat ground gets 1.
    const float lit = (glm::dot(normal, kLight) + 1) / (kLight.z + 1);
    return kSkyShare + (1 - kSkyShare) * lit * lit;
}

struct DayPainter {
    DayPainter(const PaintedArea& paintedArea, const MapColors& blockColors)
        : area(paintedArea), colors(blockColors), tinted(area, colors) {
        const int level = area.surfaces.rect.level;
        steepness = kRelief * std::pow(kReliefOfLevel, static_cast<float>(level)) /
                    static_cast<float>(world::columnWidth(level));
    }

    // Larger x is to the west: the left neighbor in the image is the column x + 1.
    float light(int x, int y) const {
        const auto height = [&](int atX, int atY) {
            return reliefHeight(colors, area.surfaces.at(atX, atY));
        };
        const float here = height(x, y);
        const glm::vec2 step(here - height(x + 1, y), here - height(x, y - 1));
        const glm::vec2 slope(height(x - 2, y) - height(x + 2, y), height(x, y + 2) - height(x, y - 2));
        return lightOn(steepness * (kStepShare * step + (1 - kStepShare) / 4 * slope));
    }
    glm::vec3 colorOf(BlockId block, int x, int y) {
        return block < colors.size() ? tinted.at(block, x, y) : glm::vec3(0.5f);
    }
    glm::vec3 color(int x, int y) {
        const SurfaceColumn& column = area.surfaces.at(x, y);
        if (!isLiquid(colors, column.top)) return colorOf(column.top, x, y) * light(x, y);
        const glm::vec3 liquid = colorOf(column.top, x, y);
        const glm::vec3 ground = colorOf(column.under, x, y) * light(x, y);
        return colorOfLiquid(colors[column.top], liquid, ground,
                             static_cast<float>(column.topZ - column.underZ));
    }

    const PaintedArea& area;
    const MapColors& colors;
    TintedColors tinted;
    float steepness = 0;
};

// The factor of the texture in a part of a block; 1 if a block is one pixel.
glm::vec3 detail(const MapColors& colors, BlockId block, glm::ivec2 texel, int scale) {
    if (scale == 1 || block >= colors.size()) return glm::vec3(1);
    const int each = kTexels / scale;
    glm::vec3 sum(0);
    for (int y = 0; y < each; ++y)
        for (int x = 0; x < each; ++x)
            sum += colors[block]
                       .texels[static_cast<std::size_t>((texel.y * each + y) * kTexels + texel.x * each + x)];
    return sum / static_cast<float>(each * each);
}

// Light of lamps by column of the area.
class LampLight {
  public:
    LampLight(const PaintedArea& area, const MapColors& colors)
        : surfaces_(area.surfaces), light_(surfaces_.columns.size(), glm::vec3(0)) {
        for (int y = 0; y < surfaces_.rect.height; ++y)
            for (int x = 0; x < surfaces_.rect.width; ++x)
                if (const BlockColor* lamp = lampAt(colors, x, y)) shine(*lamp, x, y, isInside(colors, x, y));
    }

    const glm::vec3& at(int x, int y) const { return light_[index(x, y)]; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(surfaces_.rect.width) +
               static_cast<std::size_t>(x);
    }
    bool isIn(int x, int y) const {
        return x >= 0 && y >= 0 && x < surfaces_.rect.width && y < surfaces_.rect.height;
    }
    const BlockColor* lampAt(const MapColors& colors, int x, int y) const {
        const BlockId top = surfaces_.at(x, y).top;
        return top < colors.size() && colors[top].reach > 0 ? &colors[top] : nullptr;
    }
    // In a lake of lava only the blocks at the shore light their surroundings.
    bool isInside(const MapColors& colors, int x, int y) const {
        for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
            if (isIn(x + dx, y + dy) && !lampAt(colors, x + dx, y + dy)) return false;
        return true;
    }
    void shine(const BlockColor& lamp, int x, int y, bool isInside) {
        // A lamp is visible at every zoom.
        const float reach =
            std::max(lamp.reach / static_cast<float>(world::columnWidth(surfaces_.rect.level)), 1.5f);
        const int far = isInside ? 0 : std::min(static_cast<int>(reach), kLampMargin);
        for (int dy = -far; dy <= far; ++dy) {
            for (int dx = -far; dx <= far; ++dx) {
                if (!isIn(x + dx, y + dy)) continue;
                const float distance = std::sqrt(static_cast<float>(dx * dx + dy * dy)) / (reach + 1);
                const float share = std::max(1 - distance, 0.0f);
                glm::vec3& light = light_[index(x + dx, y + dy)];
                light = glm::max(light, lamp.emission * (share * share));
            }
        }
    }

    const SurfaceArea& surfaces_;
    std::vector<glm::vec3> light_;
};

}  // namespace

base::Image paintDay(const PaintedArea& area, const MapColors& colors) {
    DayPainter painter(area, colors);
    return imageOf(gridOf(area), [&](int x, int y, glm::ivec2 texel) {
        return rgbOf(painter.color(x, y) * detail(colors, area.surfaces.at(x, y).top, texel, area.scale));
    });
}

base::Image paintNight(const PaintedArea& area, const MapColors& colors) {
    DayPainter painter(area, colors);
    const LampLight lamps(area, colors);
    return imageOf(gridOf(area), [&](int x, int y, glm::ivec2 texel) {
        const BlockId top = area.surfaces.at(x, y).top;
        const glm::vec3 day = painter.color(x, y) * detail(colors, top, texel, area.scale);
        const bool isLamp = top < colors.size() && colors[top].reach > 0;
        return rgbOf(isLamp ? day : day * (kNight + kLampShare * lamps.at(x, y)));
    });
}

}  // namespace terrane::map
