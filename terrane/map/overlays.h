// Overlays of a map: images of heights and biomes as colors. Any thread. Rows and columns as in paint.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "terrane/base/image.h"
#include "terrane/map/map_pixels.h"

namespace terrane::map {

// The color of ground at a height, 0…255: blue below the sea, then green, yellow, brown and white.
Rgb heightColor(int z);
// The color of a biome by its number (gen/generators/biomes.h).
Rgb biomeColor(std::size_t number);

// The height of the ground, under water too, with a darker line each 16 blocks. Under a crown over water the
// height of the water, since surfaces do not have its depth. The margin is kReliefMargin.
base::Image paintHeights(const PaintedArea& area);
// `biomes`: numbers of the rectangle's columns, x + width · y. Each column is `scale`² pixels.
base::Image paintBiomes(const ColumnRect& rect, int scale, std::span<const std::uint8_t> biomes);

}  // namespace terrane::map
