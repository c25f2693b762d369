#include "terrane/map/isometric.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <unordered_map>

#include "terrane/map/map_tile.h"
#include "terrane/map/paint.h"

namespace terrane::map {

using world::BlockId;
using world::ChunkPos;

namespace {

// Brightness of faces: tops, southern ones at the left, and eastern ones at the right.
constexpr float kTop = 1.0f, kSouth = 0.78f, kEast = 0.6f;
// Trees are drawn as a crown over the ground. Its thickness is this share of the height from ground to top,
// at most kMaxCrown blocks.
constexpr float kCrownShare = 0.6f;
constexpr int kMaxCrown = 6;
constexpr double kLiquidHeight = 0.9;  // of its topmost block
constexpr float kUnseenDepth = 4;      // blocks: assumed for a liquid under a crown

double pixelsOfHeight(int zoom) {
    return kIsometricHeight * std::exp2(zoom);
}

struct Canvas {
    explicit Canvas(const IsometricTile& tile)
        : x0(std::int64_t{tile.x} * kTilePixels), y0(std::int64_t{tile.y} * kTilePixels) {
        image.width = image.height = kTilePixels;
        image.rgba.resize(static_cast<std::size_t>(kTilePixels) * kTilePixels * 4);
    }
    // Fills the pixels of a column of the image whose middles are between two heights, in pixels of the zoom.
    void fill(std::int64_t x, double top, double bottom, Rgb color) {
        if (x < x0 || x >= x0 + kTilePixels) return;
        const auto row = [&](double at) {
            return static_cast<int>(
                std::clamp(std::ceil(at - 0.5) - static_cast<double>(y0), 0.0, double{kTilePixels}));
        };
        for (int y = row(top), end = row(bottom); y < end; ++y) {
            std::uint8_t* pixel =
                &image.rgba[(static_cast<std::size_t>(y) * kTilePixels + static_cast<std::size_t>(x - x0)) *
                            4];
            pixel[0] = color.red;
            pixel[1] = color.green;
            pixel[2] = color.blue;
            pixel[3] = 255;
        }
    }

    base::Image image;
    std::int64_t x0, y0;
};

// A box on a column between two heights, in blocks.
struct Box {
    double bottom, top;
    glm::vec3 color;
};

class ChunkPainter {
  public:
    ChunkPainter(Canvas& canvas, int zoom, double bottom, const MapColors& colors)
        : canvas_(canvas),
          colors_(colors),
          p_(columnPixels(zoom)),
          height_(pixelsOfHeight(zoom)),
          bottom_(bottom) {}

    // From the farthest column to the nearest one.
    void paint(ChunkPos chunk, const Surface& surface, world::PackedColor tint) {
        tinted_.clear();
        for (int y = 0; y < world::kChunkSize; ++y) {
            for (int x = world::kChunkSize; x-- > 0;) {
                const std::int64_t columnX = std::int64_t{chunk.x} * world::kChunkSize + x;
                const std::int64_t columnY = std::int64_t{chunk.y} * world::kChunkSize + y;
                paintColumn(columnX, columnY, surface[static_cast<std::size_t>(x + y * world::kChunkSize)],
                            tint);
            }
        }
    }

  private:
    void paintColumn(std::int64_t x, std::int64_t y, const SurfaceColumn& column, world::PackedColor tint) {
        if (column.top == world::kAir) return;
        const glm::vec3 top = colorOf(column.top, tint), under = colorOf(column.under, tint);
        const int above = column.topZ - column.underZ;
        if (kindOf(column.top) == SurfaceKind::Liquid)
            return paintLiquid(x, y, column.topZ,
                               colorOfLiquid(colors_[column.top], top, under, static_cast<float>(above)));
        if (kindOf(column.under) == SurfaceKind::Liquid)
            paintLiquid(x, y, column.underZ,
                        colorOfLiquid(colors_[column.under], under, under, kUnseenDepth));
        else if (column.under != world::kAir)
            paintBox(x, y, {bottom_, column.underZ + 1.0, under});
        if (kindOf(column.top) != SurfaceKind::Crown) return;
        const int thick = std::clamp(static_cast<int>(static_cast<float>(above) * kCrownShare), 1, kMaxCrown);
        paintBox(x, y, {column.topZ + 1.0 - thick, column.topZ + 1.0, top});
    }

    SurfaceKind kindOf(BlockId block) const {
        return block < colors_.size() ? colors_[block].kind : SurfaceKind::Ground;
    }

    void paintLiquid(std::int64_t x, std::int64_t y, int z, const glm::vec3& color) {
        paintBox(x, y, {bottom_, z + kLiquidHeight, color});
    }

    void paintBox(std::int64_t x, std::int64_t y, const Box& box) {
        const std::int64_t left = -(x + y + 2) * p_;
        const double middle = 0.5 * static_cast<double>((y - x) * p_);
        for (int i = 0; i < 2 * p_; ++i) {
            const double half = 0.5 * (p_ - std::abs(i + 0.5 - p_));
            const double lower = middle + half - box.top * height_;
            canvas_.fill(left + i, middle - half - box.top * height_, lower, rgbOf(box.color * kTop));
            canvas_.fill(left + i, lower, middle + half - box.bottom * height_,
                         rgbOf(box.color * (i < p_ ? kSouth : kEast)));
        }
    }

    glm::vec3 colorOf(BlockId block, world::PackedColor tint) {
        if (block >= colors_.size()) return glm::vec3(0.5f);
        const BlockColor& color = colors_[block];
        if (!color.isTinted) return color.mean;
        const auto [found, isNew] = tinted_.try_emplace(block);
        if (isNew) found->second = world::tinted(color.mean, tint);
        return found->second;
    }

    Canvas& canvas_;
    const MapColors& colors_;
    int p_;                                          // pixels of a column, which is twice as wide
    double height_, bottom_;                         // pixels of a block; z of the world's bottom
    std::unordered_map<BlockId, glm::vec3> tinted_;  // of the chunk
};

}  // namespace

std::vector<ChunkPos> visibleChunks(const IsometricTile& tile, world::Heights heights) {
    // A chunk is visible if its columns, from the world's bottom to its top, reach into the tile.
    const double width = world::kChunkSize * columnPixels(tile.zoom);  // half of a chunk's, pixels
    const double lowest = heights.bottom * pixelsOfHeight(tile.zoom),
                 highest = heights.top * pixelsOfHeight(tile.zoom);
    const double left = static_cast<double>(tile.x) * kTilePixels,
                 top = static_cast<double>(tile.y) * kTilePixels;
    // With a = -x - y and b = y - x, in chunks, a chunk reaches from (a - 2)·width to a·width, and so on.
    const auto firstA = static_cast<std::int64_t>(std::floor(left / width));
    const auto lastA = static_cast<std::int64_t>(std::ceil((left + kTilePixels) / width)) + 2;
    const auto firstB = static_cast<std::int64_t>(std::floor(2 * (top + lowest) / width)) - 1;
    const auto lastB = static_cast<std::int64_t>(std::ceil(2 * (top + kTilePixels + highest) / width)) + 1;
    std::vector<ChunkPos> chunks;
    for (std::int64_t b = firstB; b <= lastB; ++b) {
        for (std::int64_t a = firstA; a <= lastA; ++a) {
            if ((a + b) % 2 != 0) continue;
            const std::int64_t x = -(a + b) / 2, y = (b - a) / 2;
            const ChunkPos chunk{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                                 static_cast<std::uint8_t>(levelOf(tile.zoom))};
            if (chunk.x == x && chunk.y == y && world::isInWorld(chunk)) chunks.push_back(chunk);
        }
    }
    return chunks;
}

std::vector<IsometricTile> isometricTilesShowing(ChunkPos chunk, int zoom, world::Heights heights) {
    const double width = world::kChunkSize * columnPixels(zoom);
    const double lowest = heights.bottom * pixelsOfHeight(zoom), highest = heights.top * pixelsOfHeight(zoom);
    const double right = -static_cast<double>(std::int64_t{chunk.x} + chunk.y) * width;
    const double middle = 0.5 * static_cast<double>(std::int64_t{chunk.y} - chunk.x) * width;
    const auto tileAt = [](double pixel) {
        return static_cast<std::int32_t>(std::floor(pixel / kTilePixels));
    };
    std::vector<IsometricTile> tiles;
    const std::int32_t lastY = tileAt(middle + 0.5 * width - lowest);
    for (std::int32_t y = tileAt(middle - 0.5 * width - highest); y <= lastY; ++y)
        for (std::int32_t x = tileAt(right - 2 * width); x <= tileAt(right); ++x)
            tiles.push_back({zoom, x, y});
    return tiles;
}

base::Image paintIsometric(const IsometricTile& tile, const IsometricLand& land, const MapColors& colors) {
    Canvas canvas(tile);
    ChunkPainter painter(canvas, tile.zoom, land.heights.bottom, colors);
    for (std::size_t k = 0; k < land.chunks.size(); ++k)
        painter.paint(land.chunks[k], *land.surfaces[k], land.tints[k]);
    return std::move(canvas.image);
}

}  // namespace terrane::map
