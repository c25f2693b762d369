// Turns sets of visible faces of one section into merged quads in their draw buckets. section_faces.cpp uses
// it on the meshing worker's thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "terrane/mesh/bit_cube.h"
#include "terrane/mesh/mesh_options.h"
#include "terrane/mesh/quad_collector.h"
#include "terrane/shared/quad.h"
#include "terrane/world/blocks/block_type.h"

namespace terrane::mesh {

// A 16×16 plane that lies in 16 layers of 16 rows: row r is rows[r·step].
struct PlaneRows {
    std::uint16_t* rows;
    std::size_t step;    // 1: a layer, 16: across the layers
    std::uint32_t used;  // bit r: row r has bits; other rows are not read
};

// Conversion of rectangles of a plane to quads: `first` is the quad of bit 0 of row 0. The shifts are the
// places of bit and row in its first word.
struct QuadPattern {
    shared::Quad first;
    unsigned bitShift, rowShift;
};

constexpr std::size_t kMaxQuadsPerPlane = 256;  // one a bit: there can be no more

// Covers each set bit once: bits are the quads' u, rows their v. Writes at most kMaxQuadsPerPlane quads,
// ordered by row, then bit, and returns their number. The plane's content is undefined afterwards.
using MergeFunction = std::size_t (*)(const PlaneRows& plane, const QuadPattern& pattern, shared::Quad* out);

MergeFunction mergeFunction(MergeMethod method);

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
