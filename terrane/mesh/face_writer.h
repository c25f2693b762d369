// Turns sets of visible faces of one section into merged quads in their draw buckets. Used by
// section_faces.cpp on the meshing worker's thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "terrane/mesh/bit_cube.h"
#include "terrane/mesh/merge.h"
#include "terrane/mesh/quad_collector.h"
#include "terrane/world/block_type.h"

namespace terrane::mesh {

// Properties shared by the faces of a set.
struct FaceKind {
    shared::uint shapeFace;  // index into shapeFaces()
    std::uint16_t material;  // index into the materials
    bool merges;             // false: one quad a face, whatever the method
    // The side whose planes are merged. A plane's bits then run along u and its rows along v.
    world::Face plane;
};

// The faces of a section to write, and how.
struct FaceTarget {
    int baseZ = 0;      // height of the section's lowest layer
    LayerRange layers;  // of the section; faces in other layers are skipped
    MergeMethod method = MergeMethod::Greedy;
};

class FaceWriter {
  public:
    FaceWriter(std::span<const world::Material> materials, const FaceTarget& target, QuadCollector& out)
        : materials_(materials), target_(target), merge_(mergeFunction(target.method)), out_(out) {}

    // Writes the faces in `layers`, which are within those of the target. `faces` has rows along y if
    // kind.plane is -x or +x, else rows along x.
    void write(const BitCube& faces, const FaceKind& kind, LayerRange layers);

  private:
    MergeFunction mergeOf(const FaceKind& kind) const {
        return kind.merges ? merge_ : mergeFunction(MergeMethod::None);
    }
    void writeUpright(const FaceKind& kind, LayerRange layers);
    void writeLevel(const FaceKind& kind, LayerRange layers);

    std::span<const world::Material> materials_;
    FaceTarget target_;
    MergeFunction merge_;
    QuadCollector& out_;
    // State of the faces being written:
    QuadArray* bucket_ = nullptr;
    std::array<std::uint16_t, 256> rows_;  // row r of layer l is 16·l + r
    BitSlice used_;                        // rows of each layer that have bits
};

}  // namespace terrane::mesh
