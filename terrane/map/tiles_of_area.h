// Which tiles a map of an area has. Plain values; any thread.
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
// Those tiles, from the widest zoom to the finest; the layers of one place stand together, as they are
// painted from the same surfaces. None outside the world.
std::vector<MapTile> tilesOf(const BlockRect& area, std::span<const Layer> layers, int minZoom, int maxZoom);
// At least as many as those.
std::int64_t countTiles(const BlockRect& area, std::span<const Layer> layers, int minZoom, int maxZoom);

// "tiles/day/-2/4/-7.png", as URLs have it.
std::string pathOf(const MapTile& tile);

}  // namespace terrane::map
