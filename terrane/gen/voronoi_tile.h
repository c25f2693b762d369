// Voronoi points that can be the nearest or second nearest of some column of a tile.
#pragma once

#include <cstdint>
#include <vector>

#include "terrane/gen/noise.h"

namespace terrane::gen {

struct VoronoiPoint {
    std::int32_t x, y;  // blocks from the tile's first column
};

// Fills `points`, in the order of cells by y, then x, then number in the cell: of points at equal distance
// the first one counts. x0, y0: block coordinates of the tile's first column.
void prepare(std::vector<VoronoiPoint>& points, const NoiseCall& call, std::uint32_t seed, std::int32_t x0,
             std::int32_t y0);

}  // namespace terrane::gen
