// The tiles of a map of an area. Plain values; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "terrane/map/map_tile.h"

namespace terrane::map {

// Blocks x0 … x1 - 1, y0 … y1 - 1.
struct BlockRect {
    std::int64_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
BlockRect blocksOf(const world::ChunkArea& chunks);  // of level 0

// Whether some of the area, up to the world's top, may be seen in a tile.
bool shows(const MapTile& tile, const BlockRect& area);
// The tiles that show the area, from the widest zoom to the finest. Layers of one place follow each other,
// since they are painted from the same surfaces. None outside the world.
std::vector<MapTile> tilesOf(const BlockRect& area, std::span<const Layer> layers, int minZoom, int maxZoom);
// An upper bound of their number.
std::int64_t countTiles(const BlockRect& area, std::span<const Layer> layers, int minZoom, int maxZoom);

// "tiles/day/-2/4/-7.png", as in URLs.
std::string pathOf(const MapTile& tile);

}  // namespace terrane::map
