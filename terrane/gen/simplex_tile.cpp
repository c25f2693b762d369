#include "terrane/gen/simplex_tile.h"

namespace terrane::gen {
namespace {

SimplexAxis simplexAxis(std::int32_t first, std::int32_t step, std::int32_t size) {
    // Cells of 2^20 blocks, the largest there are, make periods of 2^25.4 blocks.
    const std::int32_t periodBlocks = kSimplexPeriod * size;
    const float inverseSize = 1.0f / static_cast<float>(size);
    SimplexAxis axis;
    for (std::size_t k = 0; k < kTileSize; ++k) {
        // Coordinates wrap at the world's edge.
        const auto position =
            static_cast<std::int32_t>(static_cast<std::uint32_t>(first) +
                                      static_cast<std::uint32_t>(k) * static_cast<std::uint32_t>(step));
        const std::int32_t quotient = position / periodBlocks, rest = position % periodBlocks;
        const bool isBelow = rest < 0;
        axis.period[k] = quotient - (isBelow ? 1 : 0);
        axis.cells[k] = static_cast<float>(isBelow ? rest + periodBlocks : rest) * inverseSize;
    }
    return axis;
}

}  // namespace

void prepare(Simplex2DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid) {
    const std::vector<Octave> octaves = octavesOf(call);
    tile.octaves.resize(octaves.size());
    for (std::size_t n = 0; n < octaves.size(); ++n) {
        const Octave& o = octaves[n];
        tile.octaves[n] = {simplexAxis(grid.x, grid.step, o.size), simplexAxis(grid.y, grid.step, o.size),
                           seed + o.seedStep, o.weight};
    }
}

}  // namespace terrane::gen
