// Runs instruction lists over a tile with the widest SIMD instructions of the machine (chosen at run time by
// Highway). All targets give the same bits.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "terrane/gen/compile/program.h"
#include "terrane/gen/cpu/block_layers.h"
#include "terrane/gen/drainage/drainage_maps.h"
#include "terrane/gen/noise/perlin_tile.h"
#include "terrane/gen/noise/simplex_tile.h"
#include "terrane/gen/noise/stamp_tile.h"
#include "terrane/gen/noise/stripe_tile.h"
#include "terrane/gen/noise/voronoi_tile.h"

namespace terrane::gen {

// A tile with its surroundings, for fields that are read with an offset: 48×48 values, the tile's first
// column at (16, 16).
constexpr int kWindowSize = kTileSize + 2 * kMaxReadOffset;

// State that instructions read and write. Filled by executor.cpp; one per thread.
struct TileContext {
    const Program* program = nullptr;
    Bits* arena = nullptr;  // 64-byte aligned; program->arenaRows rows
    std::span<const std::uint32_t> hashSeeds;
    // By index of the generator's noises; prepared when an instruction first calls them in this tile, so that
    // branches that no row takes cost nothing.
    std::vector<Perlin2DTile> perlin2D;
    std::vector<Perlin3DTile> perlin3D;
    std::vector<Voronoi2DTile> voronoi2D;
    std::vector<Voronoi3DTile> voronoi3D;
    std::vector<Simplex2DTile> simplex2D;
    std::vector<Stripes2DTile> stripes2D;
    std::vector<DrainageTile> drainage;
    std::vector<std::uint8_t> isPrepared;  // by noise
    std::function<void(std::uint32_t noise)> prepareNoise;
    std::vector<const Bits*> fields;         // by field: kTileLanes values
    std::vector<std::vector<Bits>> windows;  // by field: kWindowSize² values where read with an offset
    std::vector<NoiseKind> noiseKinds;
    // Blocks of the last earlier 3D pass: of this chunk, and of the nine chunks around it by y, then x, where
    // the program reads them with an offset.
    const BlockLayers* blocks = nullptr;
    std::array<const BlockLayers*, 9> blocksAround{};
    std::vector<StampTile> stamps;  // by the pass's stamps, painted
    std::int32_t z = 0;             // of the layer
    RowMask rows = kAllRows;        // for which instructions run
    // By column: all bits set if its values are requested, else 0. Null means that all are requested.
    const Bits* requested = nullptr;
};

// Runs a list for the rows in context.rows. Values that are equal in all columns are computed whatever the
// rows.
void runInstructions(const InstructionList& list, TileContext& context);

// Returns the names of the instruction sets this machine can run, best first, as Highway calls them.
std::vector<std::string> simdTargets();
// Restricts to one of simdTargets() until called again; empty: the best. For tests and `--simd`; not while
// running.
bool chooseSimdTarget(const std::string& name);

}  // namespace terrane::gen
