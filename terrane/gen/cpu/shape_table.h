// The shapes of a generator as both back ends read them, in the columns of its level. It is made once by
// GeneratorBuilder::finish(); read by all threads.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "terrane/gen/language/voxel_shape.h"
#include "terrane/shared/generation.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::gen {

using shared::kMaxShapes;

// Voxels of one block side by side along x.
struct ShapeRun {
    std::int8_t x, y, z;  // of the first, in columns and blocks from the foot
    std::uint8_t length;
    world::BlockId block;
};

struct ShapeRecord {
    std::array<std::int8_t, 3> low{}, high{};  // of all voxels
    // Runs of rank r: runs[firstRun[r]] up to runs[firstRun[r + 1]], by z, y, x.
    std::array<std::uint32_t, kMaxShapeRank + 2> firstRun{};
};

struct ShapeTable {
    std::vector<ShapeRecord> shapes;
    std::vector<ShapeRun> runs;
};

// Adds a shape in the columns of a level. Its blocks must be in the registry.
void addShape(ShapeTable& table, const VoxelShape& shape, int level, const world::BlockRegistry& blocks);

// Returns the reason why a shape is invalid, in one line; empty if it is valid.
std::string shapeMistake(const VoxelShape& shape, const world::BlockRegistry& blocks);

// Returns the table for shaders, as gen_gpu/stamps.glsl reads it.
std::vector<std::uint32_t> shapeWords(const ShapeTable& table);
// Returns the bytes of the cells in that table.
std::size_t shapeCellBytes(const ShapeTable& table);
// Returns the number of different pairs of block and rank in the shapes; cells store it in 8 bits.
std::size_t shapePaletteSize(const ShapeTable& table);

}  // namespace terrane::gen
