// Merges set bits of a 16×16 plane into rectangles. Called by the face writer for each plane of faces; any
// thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "terrane/mesh/bit_cube.h"

namespace terrane::mesh {

enum class Merge : std::uint8_t {
    None,  // one rectangle a bit
    Full,  // runs of bits, then equal runs of the following rows
};

struct Rectangle {
    std::uint8_t bit, row;    // lowest
    std::uint8_t bits, rows;  // size, 1…16
};

using RectangleBuffer = std::array<Rectangle, 256>;  // one a bit: there can be no more

// Covers each set bit once. Rectangles are ordered by row, then bit; they lie in `buffer`.
std::span<const Rectangle> mergeRows(BitSlice rows, Merge merge, RectangleBuffer& buffer);

}  // namespace terrane::mesh
