// Simplex noise in 2D over a tile of 16×16 columns: where each column and row of the tile lies in the
// lattice.
//
// Order of operations, the same on every back end: with the position counted from the last whole period in
// cells, (fx, fy), skew = (fx + fy) · F, (i, j) = floor(fx + skew, fy + skew), unskew = (i + j) · G with
// G = 15/71, offset o = (fx − (i − unskew), fy − (j − unskew)). The corner (di, dj) has the offset
// (o.x − di) + n · G for the corners n = 0, 1, 2, and adds t⁴ · (g.x · o.x + g.y · o.y) with
// t = max(½ − (o.x² + o.y²), 0), t⁴ = (t²)². The sum (c₀ + c₁) + c₂ times kSimplexScale times the weight is
// added octave by octave.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/gen/noise/noise.h"
#include "terrane/gen/noise/perlin_tile.h"

namespace terrane::gen {

constexpr std::int32_t kSimplexPeriod = 41;  // cells
// By so many cells a period of x or y shifts both skewed axes.
constexpr std::int32_t kSimplexShift = 15;
constexpr float kSimplexSkew = 15.0f / 41.0f, kSimplexUnskew = 15.0f / 71.0f;  // F, F / (1 + 2 F)
constexpr float kSimplexScale = 70.3f;  // one over the largest sum that any gradients can give

// One axis of the tile: periods before each column or row, and cells from there.
struct SimplexAxis {
    alignas(64) std::array<std::int32_t, kTileSize> period{};
    alignas(64) TileRow cells{};
};

struct Simplex2DTile {
    struct Octave {
        SimplexAxis x, y;
        std::uint32_t seed = 0;
        float weight = 0;
    };
    std::vector<Octave> octaves;
};

void prepare(Simplex2DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid);

}  // namespace terrane::gen
