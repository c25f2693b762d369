// Layers, zooms and tiles of a map, and the land that a tile shows. All are plain values; any thread may use
// them.
//
// North is up: a tile's first row is the one with the smallest y, and its first column the one with the
// largest x (east is -x, docs/building.md). A tile is 256×256 pixels. At zoom 0 a pixel is a block, at zoom 2
// a block is 4×4 pixels, at zoom -10 a pixel is 1,024 blocks wide.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/world/coords.h"

namespace terrane::map {

constexpr int kTilePixels = 256;
constexpr int kMinZoom = -10, kMaxZoom = 2;

enum class Layer : std::uint8_t { Day, Night, Height, Biome, Isometric };
constexpr int kLayerCount = 5;
std::string_view nameOf(Layer layer);  // "day", as in URLs
std::optional<Layer> layerNamed(std::string_view name);

// Tile x of zoom z shows the blocks from x · width to (x + 1) · width - 1, width = 256 / 2^z; y as well.
struct MapTile {
    Layer layer = Layer::Day;
    int zoom = 0;
    std::int32_t x = 0, y = 0;

    auto operator<=>(const MapTile&) const = default;
};

// Returns the level of the chunks that a zoom is painted from: one column a pixel; above zoom 0 a block is
// several pixels.
constexpr int levelOf(int zoom) {
    return zoom < 0 ? -zoom : 0;
}
// Returns the number of pixels along each side of a column, seen from above.
constexpr int columnPixels(int zoom) {
    return zoom > 0 ? 1 << zoom : 1;
}
constexpr std::int64_t blocksAcross(int zoom) {
    return zoom < 0 ? std::int64_t{kTilePixels} << -zoom : kTilePixels >> zoom;
}
// Returns the number of the tile that holds a column, if tiles are `across` columns wide.
constexpr std::int64_t tileOf(std::int64_t column, std::int64_t across) {
    return column >= 0 ? column / across : (column + 1) / across - 1;
}
struct MapTileHash {
    std::size_t operator()(const MapTile& tile) const;
};

// Returns whether some of the tile is in the world.
bool isInWorld(const MapTile& tile);

// The tiles of a map of an area. All are plain values; any thread may use them. Blocks x0 … x1 - 1, y0 … y1 -
// 1, of a world of these heights.
struct BlockRect {
    std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    world::Heights heights = {};
};
BlockRect blocksOf(const world::ChunkArea& chunks, world::Heights heights);  // chunks of level 0

// Returns whether some of the area, from the world's bottom to its top, may be visible in a tile.
bool shows(const MapTile& tile, const BlockRect& area);
// Returns the tiles that show the area, from the widest zoom to the finest. Layers of one place follow each
// other, since they are painted from the same surfaces. Returns nothing outside the world.
std::vector<MapTile> tilesOf(const BlockRect& area, std::span<const Layer> layers, int minZoom, int maxZoom);
// Returns an upper bound of the number of these tiles.
std::int64_t countTiles(const BlockRect& area, std::span<const Layer> layers, int minZoom, int maxZoom);

// Returns the path of a tile as in URLs: "tiles/day/-2/4/-7.png".
std::string pathOf(const MapTile& tile);

}  // namespace terrane::map
