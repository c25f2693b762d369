#include "terrane/map/map_tile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "terrane/map/isometric.h"

namespace terrane::map {

namespace {

constexpr std::array<std::string_view, kLayerCount> kLayerNames = {"day", "night", "height", "biome",
                                                                   "isometric"};

}  // namespace

std::string_view nameOf(Layer layer) {
    return kLayerNames[static_cast<std::size_t>(layer)];
}

std::optional<Layer> layerNamed(std::string_view name) {
    const auto found = std::ranges::find(kLayerNames, name);
    if (found == kLayerNames.end()) return std::nullopt;
    return static_cast<Layer>(found - kLayerNames.begin());
}

bool isInWorld(const MapTile& tile) {
    // Isometric tiles are numbered by pixels: sums of the world's two coordinates, and of the height.
    const std::int64_t reach = tile.layer == Layer::Isometric ? std::int64_t{1} << 32 : std::int64_t{1} << 31;
    const std::int64_t across = blocksAcross(tile.zoom);
    const auto isIn = [&](std::int32_t number) {
        return number * across < reach && (number + std::int64_t{1}) * across > -reach;
    };
    return isIn(tile.x) && isIn(tile.y);
}

std::size_t MapTileHash::operator()(const MapTile& tile) const {
    const std::uint64_t place =
        std::uint64_t{static_cast<std::uint32_t>(tile.x)} << 32 | static_cast<std::uint32_t>(tile.y);
    const std::uint64_t kind =
        static_cast<std::uint64_t>(tile.layer) << 8 | static_cast<std::uint8_t>(tile.zoom);
    const std::uint64_t spread = (place ^ kind << 27) * 0x9E3779B97F4A7C15u;
    return spread ^ spread >> 32;
}

namespace {

struct Range {
    double low, high;
};
bool meet(const Range& a, const Range& b) {
    return a.low < b.high && b.low < a.high;
}

// Pixels of zoom 0, to the right and downward.
struct PixelRect {
    Range x, y;
};

PixelRect pixelsOf(const MapTile& tile) {
    const double size = kTilePixels / std::exp2(tile.zoom);
    return {{tile.x * size, (tile.x + 1.0) * size}, {tile.y * size, (tile.y + 1.0) * size}};
}

// The isometric bounds of an area and all that can stand on it.
PixelRect seenPixels(const BlockRect& area) {
    const auto x0 = static_cast<double>(area.x0), x1 = static_cast<double>(area.x1);
    const auto y0 = static_cast<double>(area.y0), y1 = static_cast<double>(area.y1);
    return {{-x1 - y1, -x0 - y0},
            {(y0 - x1) / 2 - kIsometricHeight * area.heights.top,
             (y1 - x0) / 2 - kIsometricHeight * area.heights.bottom}};
}

// Two convex shapes meet unless an edge of one of them separates them: the tile's edges are lines of equal X
// or Y, the area's of equal x or y (of the world's bottom, and of its top).
bool isSeen(const MapTile& tile, const BlockRect& area) {
    const PixelRect pixels = pixelsOf(tile), seen = seenPixels(area);
    const double top = pixels.y.low + kIsometricHeight * area.heights.bottom;
    const double bottom = pixels.y.high + kIsometricHeight * area.heights.top;
    const Range x{-pixels.x.high / 2 - bottom, -pixels.x.low / 2 - top};
    const Range y{top - pixels.x.high / 2, bottom - pixels.x.low / 2};
    return meet(pixels.x, seen.x) && meet(pixels.y, seen.y) &&
           meet(x, {static_cast<double>(area.x0), static_cast<double>(area.x1)}) &&
           meet(y, {static_cast<double>(area.y0), static_cast<double>(area.y1)});
}

// Tiles x0 … x1 - 1, y0 … y1 - 1 of a zoom.
struct TileRange {
    std::int64_t x0, y0, x1, y1;
    std::int64_t count() const { return (x1 - x0) * (y1 - y0); }
};

TileRange tilesAround(Layer layer, int zoom, const BlockRect& area) {
    if (layer == Layer::Isometric) {
        const PixelRect seen = seenPixels(area);
        const double size = kTilePixels / std::exp2(zoom);
        const auto down = [size](double pixel) {
            return static_cast<std::int64_t>(std::floor(pixel / size));
        };
        const auto up = [size](double pixel) { return static_cast<std::int64_t>(std::ceil(pixel / size)); };
        return {down(seen.x.low), down(seen.y.low), up(seen.x.high), up(seen.y.high)};
    }
    const std::int64_t across = blocksAcross(zoom);
    return {tileOf(area.x0, across), tileOf(area.y0, across), tileOf(area.x1 - 1, across) + 1,
            tileOf(area.y1 - 1, across) + 1};
}

}  // namespace

BlockRect blocksOf(const world::ChunkArea& chunks, world::Heights heights) {
    constexpr std::int64_t kSize = world::kChunkSize;
    return {chunks.x0 * kSize, chunks.y0 * kSize, chunks.x1 * kSize, chunks.y1 * kSize, heights};
}

bool shows(const MapTile& tile, const BlockRect& area) {
    if (!isInWorld(tile)) return false;
    if (tile.layer == Layer::Isometric) return isSeen(tile, area);
    const TileRange range = tilesAround(tile.layer, tile.zoom, area);
    return tile.x >= range.x0 && tile.x < range.x1 && tile.y >= range.y0 && tile.y < range.y1;
}

std::vector<MapTile> tilesOf(const BlockRect& area, std::span<const Layer> layers, int minZoom, int maxZoom) {
    std::vector<MapTile> tiles;
    const auto add = [&](std::span<const Layer> together, int zoom) {
        const TileRange range = tilesAround(together.front(), zoom, area);
        for (std::int64_t y = range.y0; y < range.y1; ++y)
            for (std::int64_t x = range.x0; x < range.x1; ++x)
                for (const Layer layer : together) {
                    const MapTile tile{layer, zoom, static_cast<std::int32_t>(x),
                                       static_cast<std::int32_t>(y)};
                    if (shows(tile, area)) tiles.push_back(tile);
                }
    };
    std::vector<Layer> flat(layers.begin(), layers.end());
    const bool hasIsometric = std::erase(flat, Layer::Isometric) > 0;
    constexpr Layer kIsometric[] = {Layer::Isometric};
    for (int zoom = minZoom; zoom <= maxZoom; ++zoom) {
        if (!flat.empty()) add(flat, zoom);
        if (hasIsometric) add(kIsometric, zoom);
    }
    return tiles;
}

std::int64_t countTiles(const BlockRect& area, std::span<const Layer> layers, int minZoom, int maxZoom) {
    std::int64_t count = 0;
    for (int zoom = minZoom; zoom <= maxZoom; ++zoom)
        for (const Layer layer : layers) count += tilesAround(layer, zoom, area).count();
    return count;
}

std::string pathOf(const MapTile& tile) {
    return fmt::format("tiles/{}/{}/{}/{}.png", nameOf(tile.layer), tile.zoom, tile.x, tile.y);
}

}  // namespace terrane::map
