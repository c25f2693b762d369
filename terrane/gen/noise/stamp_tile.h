// The blocks that shapes put into one tile. Painted by executor.cpp before it runs a pass; one for each
// stamp call of a pass and thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrane/gen/compile/op.h"
#include "terrane/gen/cpu/shape_table.h"
#include "terrane/world/coords.h"

namespace terrane::gen {

// Foot of a shape: x and y in columns from the tile's corner, z in blocks.
struct StampFoot {
    const ShapeRecord* shape;
    int x, y, z;
};

class StampTile {
  public:
    // Paints the shapes of all feet in 48×48 columns around the tile (kWindowSize of kernels.h). `numbers`:
    // the shape of a column, if the table has it. `bases`: height of its foot. Where blocks of several shapes
    // meet in a voxel, the highest rank stays, then the smallest y, then the smallest x of the foot.
    void paint(const ShapeTable& shapes, std::span<const Bits> numbers, std::span<const Bits> bases);

    bool isPainted(int z) const { return painted_[static_cast<std::size_t>(z)]; }
    // Returns whether any layer from low to high, both in the world, has blocks.
    bool isPainted(int low, int high) const;
    // Returns 256 blocks, air where there is no shape. The layer must be painted.
    const std::uint16_t* layer(int z) const;

  private:
    void clear();
    void findFeet(const ShapeTable& shapes, std::span<const Bits> numbers, std::span<const Bits> bases);
    void paintRun(const StampFoot& foot, const ShapeRun& run);

    std::vector<std::uint16_t> blocks_;  // by world::BlockIndex
    std::array<bool, world::kChunkHeight> painted_{};
    std::vector<StampFoot> feet_;  // by y, then x
};

}  // namespace terrane::gen
