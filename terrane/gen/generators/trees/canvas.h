// The voxels of a shape while it is drawn. One thread at a time may use it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/gen/generators/trees/tree_math.h"
#include "terrane/gen/language/voxel_shape.h"

namespace terrane::gen::trees {

constexpr int kLeafRank = 0, kWoodRank = 1;

class Canvas {
  public:
    using Paint = std::uint8_t;  // 0 is empty
    Canvas();

    Paint paint(std::string_view block, int rank);

    bool isInside(int x, int y, int z) const;
    Paint at(int x, int y, int z) const;  // 0 outside
    // Ignores positions outside a shape's bounds. Leaves never replace wood.
    void set(int x, int y, int z, Paint paint);
    bool isWood(Paint paint) const { return paint != 0 && blocks_[paint - 1u].rank >= kWoodRank; }

    // Draws a limb whose radius changes from one end to the other; one voxel wide below a radius of 0.75.
    void limb(Point from, Point to, float fromRadius, float toRadius, Paint paint);
    // Draws an ellipsoid with random gaps in its outer part: the share `edge` of its outermost voxels stays.
    void clump(Point middle, Point radii, float edge, Paint paint, Random& random);

    // Removes voxels that are not connected to (0, 0, 0): by faces, wood to wood also by edges and corners.
    void removeDisconnected();
    // Returns the drawn voxels, by z, y, x.
    VoxelShape shape(std::string name) const;

  private:
    static std::size_t index(int x, int y, int z);
    void ball(Point middle, float radius, Paint paint);

    std::vector<ShapeBlock> blocks_;
    std::vector<Paint> cells_;
};

}  // namespace terrane::gen::trees
