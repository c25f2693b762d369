// Stripes over a tile of 16×16 columns: waves that run across a direction given at each column. Waves of
// random phase start at a jittered point of each cell of `size` blocks and blend into each other, so that
// stripes bend with the direction and join and end here and there. After C. John, F. Westin and
// R. S. Johansen, who draw erosion gullies with them (see compounds.h).
//
// The point of a cell lies at ¼…¾ of it in x and y. Its offset from the column, in cells, is o; its weight is
// w = max(0, 1 − |o|² / kStripeReach2)², which is 0 beyond the 3×3 cells around. With the direction d of
// length 1 and the point's phase p, the wave's phase there is p − o·d turns. Results: Σ w cos / Σ w and
// Σ w sin / Σ w, with parabolas for the waves: sin of q turns is q (8 − 16 |q|) for q in −½…½.
// Order of operations: points by y, then x; o = float(cell · size − position) · (1 / size) + point;
// |o|² = o.x² + o.y²; o·d = o.x d.x + o.y d.y.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "terrane/gen/compile/program.h"
#include "terrane/gen/noise/noise.h"
#include "terrane/gen/noise/sample_grid.h"

namespace terrane::gen {

// A little less than 1.25², the least distance of points beyond the cells around: roundings do not reach it.
constexpr float kStripeReach2 = 1.55f;
static_assert(std::bit_cast<std::uint32_t>(1.0f / kStripeReach2) == 0x3F25294B,
              "as gen_gpu/stripes.glsl has it");

struct StripePoint {
    float x, y;   // in its cell, ¼…¾
    float phase;  // turns, 0…1
};

struct Stripes2DTile {
    std::int32_t size = 1;
    SampleGrid grid;
    std::array<std::uint8_t, kTileSize> cellX{}, cellY{};  // of columns and rows, from the cell of the first
    std::uint32_t firstX = 0, firstY = 0;                  // the cell before that of the first, modulo 2^32
    int width = 0;                                         // cells
    std::vector<StripePoint> points;                       // x + width · y, from (firstX, firstY)
};

// Prepares a tile. `call.size` is at least the grid's step.
void prepare(Stripes2DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid);

}  // namespace terrane::gen
