// Turns sets of visible faces of one section into merged quads in the right buckets. Used by
// section_faces.cpp on the meshing worker's thread.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "terrane/mesh/bit_cube.h"
#include "terrane/mesh/greedy_merge.h"
#include "terrane/mesh/quad_buckets.h"
#include "terrane/world/block_type.h"

namespace terrane::mesh {

// What the faces of one set have in common.
struct FaceKind {
    shared::uint shapeFace;  // index into shapeFaces()
    std::uint16_t material;  // index into the materials
    Merge merge;
    // The side whose planes are merged. A plane's bits then run along u and its rows along v.
    world::Face plane;
};

class FaceWriter {
  public:
    // `baseZ` is the height of the section's lowest layer.
    FaceWriter(std::span<const world::Material> materials, int baseZ, QuadBuckets& out)
        : materials_(materials), baseZ_(baseZ), out_(out) {}

    // `faces` has rows along y where kind.plane is -x or +x, else rows along x.
    void write(const BitCube& faces, const FaceKind& kind);

  private:
    struct Plane;
    void writeUpright(const BitCube& faces, const FaceKind& kind);
    void writeLevel(const BitCube& faces, const FaceKind& kind);
    std::pair<int, int> writePlane(const BitSlice& rows, const Plane& plane);

    std::span<const world::Material> materials_;
    int baseZ_;
    QuadBuckets& out_;
    std::vector<shared::Quad>* bucket_ = nullptr;  // of the faces being written
    RectangleBuffer rectangles_;
};

}  // namespace terrane::mesh
