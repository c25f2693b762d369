// Merges set bits of a 16×16 plane into quads, by one of the methods. Called by the face writer for each
// plane of faces; any thread.
#pragma once

#include <cstddef>
#include <cstdint>

#include "terrane/mesh/mesh_options.h"
#include "terrane/shared/quad.h"

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

}  // namespace terrane::mesh
