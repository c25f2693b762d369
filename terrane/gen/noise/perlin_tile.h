// Perlin noise over a tile of 16×16 columns: everything that samples share is computed once.
//
// Between two lattice nodes along x the noise is a blend of two linear functions of the other offsets, so a
// node row (all nodes of equal y, or equal y and z) is stored as the coefficients of the blended function for
// each of the 16 x of the tile. A sample then costs one multiply-add at each of two node rows and one blend.
// noise.h states the order of operations; perlin_tile.cpp and noise_kernels-inl.h follow it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/gen/compile/program.h"
#include "terrane/gen/noise/lattice_kernels.h"
#include "terrane/gen/noise/noise.h"
#include "terrane/gen/noise/sample_grid.h"

namespace terrane::gen {

// Rows of lattice nodes around 16 columns: 16 cells and one more with a lattice as wide as a column. At
// higher levels smaller ones have faded (fadedWeights, noise.h).
constexpr int kMaxNodeRows = kTileSize + 1;

// The blend along y: row r lies between node rows node[r] and node[r] + 1, at the fractions `offset`.
struct RowBlend {
    std::array<std::uint8_t, kTileSize> node{};
    TileRow offset{};  // 0…1 from the lower node row
    TileRow fade{};
};

// noise(x, r) = lerp(a[j] + b[j]·f, a[j+1] + b[j+1]·(f − 1), fade[r]) with j = node[r], f = offset[r]
struct PerlinOctave {
    alignas(64) std::array<TileRow, kMaxNodeRows> a, b;
    RowBlend rows;
    float weight = 0;
    int nodeRows = 0;
};

struct Perlin2DTile {
    std::vector<PerlinOctave> octaves;
};

// Prepares a tile. No octave of the call is smaller than the grid's step.
void prepare(Perlin2DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid);

// One level of lattice nodes of equal z: coefficients of 1, of the y offset and of the z offset.
struct PerlinLevel {
    alignas(64) std::array<TileRow, kMaxNodeRows> one, y, z;
};

struct Perlin3DTile {
    struct Octave {
        PerlinOctave
            layer;  // levels blended along z for the current layer, by perlin3D in noise_kernels-inl.h
        AxisCells x;
        std::uint32_t yCell = 0;
        std::int32_t size = 1;
        std::int32_t zStart = 0;  // of the cell that holds the layer
        float inverseSize = 1;
        float zOffset = 0, zFade = 0;  // of the layer, in its cell
        std::uint32_t seed = 0;
        std::array<PerlinLevel, 2> levels;
        std::size_t low = 0;  // the one at zStart; the other is above it
    };
    std::vector<Octave> octaves;
    std::int32_t layer = kNoLayer;
};

void prepare(Perlin3DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid);
// Fills the levels around the layer z. Cheapest when called for each z in order.
void moveToCellsOf(Perlin3DTile& tile, std::int32_t z);

}  // namespace terrane::gen
