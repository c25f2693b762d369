#include "terrane/gen/drainage/drainage_heights.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "terrane/gen/cpu/executor.h"
#include "terrane/shared/hash.h"

namespace terrane::gen {
namespace {

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

std::shared_ptr<const DrainageHeights::Block> DrainageHeights::findBlock(world::ChunkPos tile) const {
    const std::lock_guard lock(mutex_);
    if (const auto found = blocks_.find(tile); found != blocks_.end()) return found->second;
    const auto found = olderBlocks_.find(tile);
    if (found == olderBlocks_.end()) return nullptr;
    auto block = found->second;
    blocks_.emplace(tile, block);
    return block;
}

// Runs the author's expression on a tile of samples. Two threads may make the same block.
std::shared_ptr<const DrainageHeights::Block> DrainageHeights::makeBlock(Executor& executor,
                                                                         world::ChunkPos tile) const {
    ColumnValues values, gradients{};
    ColumnValues* const results[] = {&values, &gradients};
    PassInputs inputs;
    inputs.chunk = tile;
    executor.run2D(program_, inputs, std::span(results).first(hasValleys() ? 2 : 1));
    const int width = graph_.spec.spacing / kCellSamples;
    auto block = std::make_shared<Block>();
    for (int n = 0; n < kBlockNodes; ++n) {
        const int x = n % kBlockCells, y = n / kBlockCells;
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
        const std::uint32_t h = hash({tile.x * kBlockCells + x, tile.y * kBlockCells + y});
        const auto at = static_cast<std::size_t>(n);
        block->heights[at] = heightKey(height, h);
        block->gradients[at] = gradient;
        block->places[at] = {placeAlong(lowest % kCellSamples, width, shared::mixBits(h + shared::kHashX)),
                             placeAlong(lowest / kCellSamples, width, shared::mixBits(h + shared::kHashY))};
    }
    const std::lock_guard lock(mutex_);
    if (blocks_.size() >= kMaxBlocks) {
        olderBlocks_ = std::move(blocks_);
        blocks_.clear();
    }
    blocks_.emplace(tile, block);
    return block;
}

DrainageNodes DrainageHeights::nodes(DrainageCell corner, int side) const {
    assert(corner.x % kBlockCells == 0 && corner.y % kBlockCells == 0 && side % kBlockCells == 0 &&
           "nodes are computed in whole blocks");
    const auto level = static_cast<std::uint8_t>(drainageLevel(graph_.spec));
    const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    DrainageNodes nodes{std::vector<HeightKey>(count), std::vector<float>(hasValleys() ? count : 0),
                        std::vector<NodePlace>(count)};
    Executor executor(graph_.noises, seeds_);
    for (int y = 0; y < side; y += kBlockCells) {
        for (int x = 0; x < side; x += kBlockCells) {
            const DrainageCell first = wrapped({corner.x + x, corner.y + y}, graph_.spec.spacing);
            const world::ChunkPos tile = {first.x / kBlockCells, first.y / kBlockCells, level};
            std::shared_ptr<const Block> block = findBlock(tile);
            if (!block) block = makeBlock(executor, tile);
            for (int row = 0; row < kBlockCells; ++row) {
                const auto to = (y + row) * side + x, from = row * kBlockCells;
                std::copy_n(block->heights.begin() + from, kBlockCells, nodes.heights.begin() + to);
                std::copy_n(block->places.begin() + from, kBlockCells, nodes.places.begin() + to);
                if (hasValleys())
                    std::copy_n(block->gradients.begin() + from, kBlockCells, nodes.gradients.begin() + to);
            }
        }
    }
    return nodes;
}

}  // namespace terrane::gen
