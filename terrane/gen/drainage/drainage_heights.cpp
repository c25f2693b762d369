#include "terrane/gen/drainage/drainage_heights.h"

#include <bit>
#include <cassert>

#include "terrane/gen/cpu/executor.h"
#include "terrane/shared/hash.h"

namespace terrane::gen {
namespace {

constexpr int kTileCells = kTileSize / kCellSamples;

// The node's place along one axis, in 1/16 blocks from the cell's corner: a random place in the middle three
// quarters of the sample's square, which is `width` blocks wide.
std::int32_t placeAlong(int sample, int width, std::uint32_t hash) {
    const std::int32_t square = width * kPlaceUnits;
    return sample * square + square / 8 +
           static_cast<std::int32_t>(((hash >> 16) * static_cast<std::uint32_t>(square / 4 * 3)) >> 16);
}

}  // namespace

int drainageLevel(const DrainageSpec& spec) {
    return std::bit_width(static_cast<unsigned>(spec.spacing)) - 1 - kCellSamplesLog2;
}

DrainageCell wrapped(DrainageCell cell, int spacing) {
    const int bits = std::bit_width(static_cast<unsigned>(spacing)) - 1;
    const auto wrap = [bits](std::int32_t v) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(v) << bits) >> bits;
    };
    return {wrap(cell.x), wrap(cell.y)};
}

DrainageHeights::DrainageHeights(const DrainageGraph& graph, std::uint64_t worldSeed)
    : graph_(graph),
      seeds_(makeSeeds(graph.noises, graph.hashNames, worldSeed)),
      seed_(seedOf("drainage " + graph.name, worldSeed)),
      program_(compile(graph.heights, graph.noises)) {}

std::uint32_t DrainageHeights::hash(DrainageCell cell) const {
    return shared::hash2(static_cast<std::uint32_t>(cell.x), static_cast<std::uint32_t>(cell.y), seed_);
}

DrainageNodes DrainageHeights::nodes(DrainageCell corner, int side) const {
    assert(corner.x % kTileCells == 0 && corner.y % kTileCells == 0 && side % kTileCells == 0 &&
           "nodes are computed in whole tiles");
    const int spacing = graph_.spec.spacing, level = drainageLevel(graph_.spec);
    const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    DrainageNodes nodes{std::vector<HeightKey>(count), std::vector<float>(hasValleys() ? count : 0),
                        std::vector<NodePlace>(count)};
    Executor executor(graph_.noises, seeds_);
    ColumnValues values, gradients;
    ColumnValues* const results[] = {&values, &gradients};
    for (int tile = 0; tile < side / kTileCells * (side / kTileCells); ++tile) {
        const int tileX = tile % (side / kTileCells) * kTileCells,
                  tileY = tile / (side / kTileCells) * kTileCells;
        PassInputs inputs;
        const DrainageCell first = wrapped({corner.x + tileX, corner.y + tileY}, spacing);
        inputs.chunk = {first.x / kTileCells, first.y / kTileCells, static_cast<std::uint8_t>(level)};
        executor.run2D(program_, inputs, std::span(results).first(hasValleys() ? 2 : 1));
        for (int n = 0; n < kTileCells * kTileCells; ++n) {
            const int x = n % kTileCells, y = n / kTileCells;
            int lowest = 0;
            float height = 0.0f, gradient = 0.0f;
            for (int s = 0; s < kCellSamples * kCellSamples; ++s) {
                const int column =
                    x * kCellSamples + s % kCellSamples + kTileSize * (y * kCellSamples + s / kCellSamples);
                const float v = asFloat(values[static_cast<std::size_t>(column)]);
                if (s > 0 && !(v < height)) continue;
                height = v;
                lowest = s;
                gradient = asFloat(gradients[static_cast<std::size_t>(column)]);
            }
            const std::uint32_t h = hash({first.x + x, first.y + y});
            const auto at = static_cast<std::size_t>((tileY + y) * side + tileX + x);
            nodes.heights[at] = heightKey(height, h);
            if (hasValleys()) nodes.gradients[at] = gradient;
            nodes.places[at] = {placeAlong(lowest % kCellSamples, spacing / kCellSamples,
                                           shared::mixBits(h + shared::kHashX)),
                                placeAlong(lowest / kCellSamples, spacing / kCellSamples,
                                           shared::mixBits(h + shared::kHashY))};
        }
    }
    return nodes;
}

}  // namespace terrane::gen
