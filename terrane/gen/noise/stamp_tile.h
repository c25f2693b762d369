// The blocks that shapes put into one tile. Painted by executor.cpp before it runs a pass; one for each
// stamp call of a pass and thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrane/gen/compile/op.h"
#include "terrane/gen/cpu/block_layers.h"
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
    // Paints the shapes of all feet in 48×48 columns around the tile (kWindowSize of kernels.h), as far as
    // they are in a world of these heights. `numbers`: the shape of a column, if the table has it. `bases`:
    // height of its foot. Where blocks of several shapes meet in a voxel, the highest rank stays, then the
    // smallest y, then the smallest x of the foot.
    void paint(const ShapeTable& shapes, world::Heights heights, std::span<const Bits> numbers,
               std::span<const Bits> bases);

    // Returns the painted blocks, air where there is no shape. The range of a layer is that of all blocks if
    // a shape reaches it.
    const BlockLayers& blocks() const { return blocks_; }

  private:
    void findFeet(const ShapeTable& shapes, std::span<const Bits> numbers, std::span<const Bits> bases);
    void paintRuns(const StampFoot& foot, std::span<const ShapeRun> runs);

    BlockLayers blocks_;
    std::vector<StampFoot> feet_;  // by y, then x
};

}  // namespace terrane::gen
