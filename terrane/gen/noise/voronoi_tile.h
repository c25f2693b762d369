// Voronoi points that can be the nearest or second nearest of some column or voxel of a tile.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/gen/noise/noise.h"
#include "terrane/gen/noise/sample_grid.h"

namespace terrane::gen {

struct VoronoiPoint {
    std::int32_t x, y;  // blocks from the tile's first column
};

struct Voronoi2DTile {
    // In the order of cells by y, then x, then number in the cell: of points at equal distance the first one
    // counts.
    std::vector<VoronoiPoint> points;
    std::int32_t size = 1, step = 1;
};

// Prepares a tile. The call's cells are at least as wide as the grid's step: at most (16 + 5)² of them are
// searched.
void prepare(Voronoi2DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid);

struct Voronoi3DPoint {
    std::int32_t x, y;  // blocks from the tile's first column
    std::int32_t z;     // block
};

struct Voronoi3DTile {
    NoiseCall call;
    std::uint32_t seed = 0;
    SampleGrid grid;
    std::int32_t zCell = 0;
    // Points of the cells that the search covers: around zCell, from below, each in the order of y, then x.
    std::array<std::vector<Voronoi3DPoint>, 5> cells;
    std::vector<Voronoi3DPoint> points;  // of these the ones that count in the current layer
    std::int32_t layer = kNoLayer;
};

void prepare(Voronoi3DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid);
// Finds the points of a layer. It is cheapest when called for each z in order.
void moveToLayer(Voronoi3DTile& tile, std::int32_t z);

}  // namespace terrane::gen
