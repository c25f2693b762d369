// Gradients of lattice nodes over 16 columns, with SIMD instructions. perlin_tile.cpp makes tiles of them.
#pragma once

#include <array>
#include <cstdint>

#include "terrane/gen/compile/program.h"

namespace terrane::gen {

using TileRow = std::array<float, kTileSize>;

// Cells and fractions of the coordinates of 16 columns in a row.
struct AxisCells {
    std::array<std::uint32_t, kTileSize> cell;  // modulo 2^32
    TileRow offset;                             // 0…1 from the lower node
    TileRow fadeOf;
};

// Returns the cells of 16 columns `step` blocks apart, the first at block `first`. `size`: width of a cell,
// at least `step`.
AxisCells axisCells(std::int32_t first, std::int32_t step, std::int32_t size);

// Computes the coefficients of 1 and of the y offset along the node row `y`, blended along x. Rows of results
// are 64-byte aligned.
void fillNodeRow2D(const AxisCells& x, std::uint32_t y, std::uint32_t seed, TileRow& one, TileRow& yFactor);

// The output of the same in 3D: coefficients of 1, y and z along the node row `y` of the level `z`.
struct NodeRow3D {
    TileRow &one, &y, &z;
};
void fillNodeRow3D(const AxisCells& x, std::array<std::uint32_t, 2> yz, std::uint32_t seed, NodeRow3D row);

}  // namespace terrane::gen
