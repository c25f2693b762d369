// Precomputed voxels that a generator puts into the land as a whole: a tree, a boulder. All are plain values;
// any thread may use them. GeneratorBuilder::shape adds them, Pass::stamp places them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace terrane::gen {

// Offsets from the foot, blocks. Neighbors are read as far as kMaxReadOffset = 16.
constexpr int kMaxShapeReach = 16;
constexpr int kMinShapeZ = -8, kMaxShapeZ = 48;
// The block of the higher rank stays where shapes overlap: a neighbor's leaves do not replace wood.
constexpr int kMaxShapeRank = 3;

struct ShapeBlock {
    std::string name;  // of the registry
    int rank = 0;      // 0…kMaxShapeRank
    bool operator==(const ShapeBlock&) const = default;
};

struct ShapeVoxel {
    std::int8_t x, y, z;
    std::uint8_t block;  // number in VoxelShape::blocks
    bool operator==(const ShapeVoxel&) const = default;
};

struct VoxelShape {
    std::string name;  // in messages
    std::vector<ShapeBlock> blocks;
    std::vector<ShapeVoxel> voxels;  // each place once
};

// Returns the shape in columns that are 2^level blocks wide; z stays in blocks. The result has the columns
// that are filled most, as many as have the shape's area. The foot's column is filled from bottom to top, so
// that nothing floats: with wood where columns are at most 2 blocks wide or the trunk has half their area,
// else with leaves.
VoxelShape coarsened(const VoxelShape& shape, int level);

// Blocks (not columns) seen from above, and the highest voxel's z.
struct ShapeStatistics {
    int cover = 0, height = 0;
};
ShapeStatistics statisticsOf(const VoxelShape& shape);

}  // namespace terrane::gen
