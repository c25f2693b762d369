#include "terrane/gen/noise/simplex_tile.h"

#include <limits>

namespace terrane::gen {
namespace {

SimplexAxis simplexAxis(std::int32_t first, std::int32_t step, std::int32_t size) {
    // Cells of 2^20 blocks, the largest there are, make periods of 2^25.4 blocks.
    const std::int32_t periodBlocks = kSimplexPeriod * size;
    const float inverseSize = 1.0f / static_cast<float>(size);
    SimplexAxis axis;
    // Mostly the whole tile is in one period.
    const bool isBelow = first % periodBlocks < 0;
    const std::int32_t start = first % periodBlocks + (isBelow ? periodBlocks : 0);
    const std::int64_t width = std::int64_t{step} * (kTileSize - 1);
    if (start + width < periodBlocks && first + width <= std::numeric_limits<std::int32_t>::max()) {
        axis.period.fill(first / periodBlocks - (isBelow ? 1 : 0));
        for (std::size_t k = 0; k < kTileSize; ++k)
            axis.cells[k] = static_cast<float>(start + static_cast<std::int32_t>(k) * step) * inverseSize;
        return axis;
    }
    std::uint32_t position = static_cast<std::uint32_t>(first);
    std::int32_t period = 0, rest = 0;
    for (std::size_t k = 0; k < kTileSize; ++k) {
        const auto at = static_cast<std::int32_t>(position);
        const bool wraps = at < std::numeric_limits<std::int32_t>::min() + step;  // at the world's edge
        if (k == 0 || wraps) {
            period = at / periodBlocks;
            rest = at % periodBlocks;
        }
        if (rest < 0 || rest >= periodBlocks) {
            const std::int32_t by = rest < 0 ? -1 : 1;
            period += by;
            rest -= by * periodBlocks;
        }
        axis.period[k] = period;
        axis.cells[k] = static_cast<float>(rest) * inverseSize;
        position += static_cast<std::uint32_t>(step);
        rest += step;
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
