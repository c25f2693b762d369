#include "terrane/gen/noise/stripe_tile.h"

#include <cassert>

#include "terrane/shared/hash.h"

namespace terrane::gen {
namespace {

std::uint32_t cellOf(std::int32_t position, std::int32_t size) {
    const std::int32_t quotient = position / size;
    return static_cast<std::uint32_t>(quotient) - (position % size < 0 ? 1u : 0u);
}

// Returns the cell of the first place.
std::uint32_t setCells(std::array<std::uint8_t, kTileSize>& cells, std::int32_t first, std::int32_t step,
                       std::int32_t size) {
    const std::uint32_t firstCell = cellOf(first, size);
    for (std::size_t k = 0; k < kTileSize; ++k) {
        const std::uint32_t position = static_cast<std::uint32_t>(first) +
                                       static_cast<std::uint32_t>(k) * static_cast<std::uint32_t>(step);
        cells[k] = static_cast<std::uint8_t>(cellOf(static_cast<std::int32_t>(position), size) - firstCell);
    }
    return firstCell;
}

StripePoint stripePoint(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    const std::uint32_t h = shared::hash2(x, y, seed);
    const auto place = [](std::uint32_t bits) {
        return 0.25f + static_cast<float>(bits & 1023u) * (0.5f / 1024.0f);
    };
    return {place(h), place(h >> 10), static_cast<float>(h >> 20) * (1.0f / 4096.0f)};
}

}  // namespace

void prepare(Stripes2DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid) {
    assert(call.size >= grid.step && "a tile spans at most 16 cells");
    tile.size = call.size;
    tile.grid = grid;
    tile.firstX = setCells(tile.cellX, grid.x, grid.step, call.size) - 1;
    tile.firstY = setCells(tile.cellY, grid.y, grid.step, call.size) - 1;
    tile.width = tile.cellX.back() + 3;
    const int height = tile.cellY.back() + 3;
    tile.points.clear();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < tile.width; ++x) {
            tile.points.push_back(stripePoint(tile.firstX + static_cast<std::uint32_t>(x),
                                              tile.firstY + static_cast<std::uint32_t>(y), seed));
        }
    }
}

}  // namespace terrane::gen
