// Images of surfaces seen from above: by day with relief, by night with lamps. Any thread may use it.
//
// North is up: the first row of pixels is the one with the smallest y, the first pixel of a row the one with
// the largest x.
#pragma once

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/result.h"
#include "terrane/map/surface.h"
#include "terrane/map/surface_source.h"
#include "terrane/map/tint_field.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::map {

// The colors of blocks on a map: means of their top faces and, for blocks several pixels wide, 4×4 texels.
// All are plain values; any thread may use them.
constexpr int kTexels = 4;  // along each side of a block

struct BlockColor {
    glm::vec3 mean{0};                                  // sRGB, 0…1
    std::array<glm::vec3, kTexels * kTexels> texels{};  // the same, divided by the mean
    bool isTinted = false;
    SurfaceKind kind = SurfaceKind::Ground;
    glm::vec3 emission{0};  // 0…1
    float reach = 0;        // distance to which it shines, blocks
};
using MapColors = std::vector<BlockColor>;  // by block id

// Returns the color of a liquid with ground under it: deeper is darker and shows less of the ground.
glm::vec3 throughLiquid(const glm::vec3& liquid, const glm::vec3& ground, float depthBlocks);
// Returns the same for a block; a glowing liquid hides its ground. `liquid` is the block's color, tinted.
glm::vec3 colorOfLiquid(const BlockColor& block, const glm::vec3& liquid, const glm::vec3& ground,
                        float depthBlocks);

// Computes the colors. It fails if a texture cannot be read; the message names it.
[[nodiscard]] base::Result<MapColors> mapColors(const world::BlockRegistry& blocks,
                                                const world::TextureSource& textures);

// Columns that an area needs around the painted ones: relief is the slope of the columns around, and lamps
// shine this far.
constexpr int kReliefMargin = 2, kLampMargin = 16;

// The columns to paint: those of an area without `margin` columns at each side, each as `scale`² pixels (1, 2
// or 4).
struct PaintedArea {
    const SurfaceArea& surfaces;
    const TintField& tint;
    int margin = kReliefMargin;
    int scale = 1;
};

base::Image paintDay(const PaintedArea& area, const MapColors& colors);
// Paints the area at night. The margin is kLampMargin.
base::Image paintNight(const PaintedArea& area, const MapColors& colors);

// The pixels of an area of a map in the order of an image: north up, east to the right. It is included by the
// painters of maps.
struct Rgb {
    std::uint8_t red = 0, green = 0, blue = 0;

    bool operator==(const Rgb&) const = default;
};

// Converts a color 0…1; other values are clamped.
inline Rgb rgbOf(const glm::vec3& color) {
    const glm::vec3 bytes = glm::clamp(color, 0.0f, 1.0f) * 255.0f + 0.5f;
    return {static_cast<std::uint8_t>(bytes.r), static_cast<std::uint8_t>(bytes.g),
            static_cast<std::uint8_t>(bytes.b)};
}

// Columns to paint, without `margin` columns at each side, each as `scale`² pixels.
struct PixelGrid {
    int width, height;  // columns, with the margin
    int margin, scale;
};
inline PixelGrid gridOf(const PaintedArea& area) {
    return {area.surfaces.rect.width, area.surfaces.rect.height, area.margin, area.scale};
}

// Makes an image. `color(x, y, texel)` returns the Rgb of each pixel: x, y is its column from the corner of
// the grid, `texel` the part of the column, 0…scale - 1 along both sides.
template <class Color>
base::Image imageOf(const PixelGrid& grid, Color color) {
    const int width = grid.width - 2 * grid.margin, height = grid.height - 2 * grid.margin;
    base::Image image{width * grid.scale, height * grid.scale, {}};
    image.rgba.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4);
    std::uint8_t* pixel = image.rgba.data();
    for (int row = 0; row < image.height; ++row) {
        for (int at = 0; at < image.width; ++at, pixel += 4) {
            const int x = grid.margin + width - 1 - at / grid.scale, y = grid.margin + row / grid.scale;
            const Rgb rgb = color(x, y, glm::ivec2(at % grid.scale, row % grid.scale));
            pixel[0] = rgb.red;
            pixel[1] = rgb.green;
            pixel[2] = rgb.blue;
            pixel[3] = 255;
        }
    }
    return image;
}

}  // namespace terrane::map
