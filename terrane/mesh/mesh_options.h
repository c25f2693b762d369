// User options of meshing. Plain values; the same options give the same mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "terrane/world/coords.h"

namespace terrane::mesh {

// Method that merges equal adjacent faces of a plane into quads. All but Greedy are the methods of D.
// Čejchan's thesis (2019), whose work groups limit quads to cells of 8×8 blocks.
enum class MergeMethod : std::uint8_t {
    None,        // one quad a face
    Lines,       // along rows as far as possible, then equal lengths of successive rows
    Squares,     // halves of the cells of a grid that doubles each time, alternately in both directions
    SquaresExt,  // Squares, then Lines for rectangles off the grid
    Greedy,      // runs of a row, then as many rows as contain the run; up to 16×16
    Count,
};

// The names in options, in the order of the values.
constexpr std::array<std::string_view, static_cast<std::size_t>(MergeMethod::Count)> kMergeMethodNames = {
    "none", "lines", "squares", "squares-ext", "greedy"};

// A chunk is culled and drawn in mesh sections: its columns, this many blocks high.
constexpr int kMinMeshSectionHeight = 8, kMaxMeshSectionHeight = 128;
constexpr int kDefaultMeshSectionHeight = 16;

constexpr bool isMeshSectionHeight(int height) {
    return height >= kMinMeshSectionHeight && height <= kMaxMeshSectionHeight && (height & (height - 1)) == 0;
}

struct MeshOptions {
    MergeMethod method = MergeMethod::Greedy;
    int meshSectionHeight = kDefaultMeshSectionHeight;  // blocks: 8, 16, 32, 64 or 128

    bool operator==(const MeshOptions&) const = default;
};

}  // namespace terrane::mesh
