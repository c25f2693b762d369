// Isometric tiles: land seen from the southeast and above, without perspective. Any thread may use it.
//
// A point at x, y, z (blocks) is at the pixel (of zoom 0, to the right and downward)
//     X = -x - y,  Y = (y - x) / 2 - kIsometricHeight · z
// so a column is two pixels wide and one deep, and a block 1.25 pixels high (dimetric projection, 2 : 1). At
// zoom z all of it is 2^z times as large.
#pragma once

#include <vector>

#include "terrane/base/image.h"
#include "terrane/map/paint.h"
#include "terrane/map/surface_source.h"
#include "terrane/map/tint_field.h"

namespace terrane::map {

constexpr double kIsometricHeight = 1.25;

// Tile x, y of a zoom: its pixels from 256 x, 256 y on.
struct IsometricTile {
    int zoom = 0;
    std::int32_t x = 0, y = 0;
};

// Returns the chunks of level levelOf(zoom) in a world of these heights that may be visible in a tile, the
// farthest from the eye first.
std::vector<world::ChunkPos> visibleChunks(const IsometricTile& tile, world::Heights heights);

// Returns the tiles of a zoom in which the chunk may be visible. The zoom has the chunk's level.
std::vector<IsometricTile> isometricTilesShowing(world::ChunkPos chunk, int zoom, world::Heights heights);

// The input of a tile: `chunks` is the result of visibleChunks(); `surfaces` and `tints` have one entry for
// each chunk.
struct IsometricLand {
    world::Heights heights;
    std::span<const world::ChunkPos> chunks;
    std::span<const SurfacePtr> surfaces;
    std::span<const world::PackedColor> tints;
};
base::Image paintIsometric(const IsometricTile& tile, const IsometricLand& land, const MapColors& colors);

}  // namespace terrane::map
