// The pixels of an area of a map in the order of an image: north up, east to the right. Included by the
// painters of maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "terrane/base/image.h"
#include "terrane/map/paint.h"

namespace terrane::map {

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

// `color(x, y, texel)` gives the Rgb of each pixel: x, y is its column from the corner of the grid, `texel`
// the part of the column, 0…scale - 1 along both sides.
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
