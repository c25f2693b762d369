// Columns made by hand to be painted, and the pixels that they become.
#pragma once

#include <cstddef>
#include <vector>

#include "terrane/map/paint.h"

namespace terrane::map {

// Block 1 at z = 80 everywhere, with a margin around the painted columns.
class PaintedColumns {
  public:
    PaintedColumns(int width, int height, int margin = kReliefMargin, int level = 0)
        : margin_(margin), surfaces_{{level, -margin, -margin, width + 2 * margin, height + 2 * margin}, {}} {
        surfaces_.columns.resize(
            static_cast<std::size_t>(surfaces_.rect.width) * static_cast<std::size_t>(surfaces_.rect.height),
            {1, 1, 80, 80});
        // Four samples around all of it.
        tint_ = {-1000, -1000, 200, 200, std::vector<world::PackedColor>(40000, world::kNeutralTint)};
    }

    // x and y from the first painted column; negative in the margin.
    SurfaceColumn& at(int x, int y) {
        return surfaces_
            .columns[static_cast<std::size_t>((y + margin_) * surfaces_.rect.width + x + margin_)];
    }
    TintField& tint() { return tint_; }
    PaintedArea area(int scale = 1) const { return {surfaces_, tint_, margin_, scale}; }

    // North is up, east to the right: the column x, y is in the row y, from the right.
    Rgb pixel(const base::Image& image, int x, int y, int scale = 1, int texelX = 0, int texelY = 0) const {
        const int column = image.width - (x + 1) * scale + texelX, row = y * scale + texelY;
        const auto* rgba = &image.rgba[static_cast<std::size_t>(row * image.width + column) * 4];
        return {rgba[0], rgba[1], rgba[2]};
    }

  private:
    int margin_;
    SurfaceArea surfaces_;
    TintField tint_;
};

}  // namespace terrane::map
