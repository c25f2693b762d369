// Sample positions of the columns of a chunk, at every level, and of its layers. Both back ends take
// positions from here.
#pragma once

#include <cstdint>

#include "terrane/world/coords.h"

namespace terrane::gen {

struct SampleGrid {
    std::int32_t x = 0, y = 0;  // block that stands for the first column
    std::int32_t step = 1;      // blocks from one column to the next
};

// Returns the grid of a chunk. A column is sampled at the block behind its middle; at level 0 that is its
// only block.
constexpr SampleGrid sampleGrid(world::ChunkPos pos) {
    const std::int32_t step = world::columnWidth(pos.level), width = world::kChunkSize * step;
    return {pos.x * width + step / 2, pos.y * width + step / 2, step};
}

// Stands for a layer's z where noise in space has none yet.
constexpr std::int32_t kNoLayer = world::kLowestBottom - 1;

// Returns the cell of a lattice of `size` blocks that holds a layer, also below zero.
constexpr std::int32_t cellOfLayer(std::int32_t z, std::int32_t size) {
    return z >= 0 ? z / size : ~(~z / size);
}

}  // namespace terrane::gen
