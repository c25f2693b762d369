// Merges set bits of a 16×16 plane into rectangles, by one of the methods. Called by the face writer for each
// plane of faces; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "terrane/mesh/mesh_options.h"

namespace terrane::mesh {

struct Rectangle {
    std::uint8_t bit, row;    // lowest
    std::uint8_t bits, rows;  // size, 1…16

    bool operator==(const Rectangle&) const = default;
};

using RectangleBuffer = std::array<Rectangle, 256>;  // one a bit: there can be no more

// A 16×16 plane that lies in a larger array: row r is rows[r·step]. Rows outside first … end − 1 are not
// read.
struct PlaneRows {
    std::uint16_t* rows;
    std::size_t step = 1;
    unsigned first = 0, end = 16;
};

// Covers each set bit once. Rectangles are ordered by row, then bit; they lie in `buffer`. What the plane
// holds afterwards is not defined.
using MergeFunction = std::span<const Rectangle> (*)(const PlaneRows& plane, RectangleBuffer& buffer);

MergeFunction mergeFunction(Method method);

// Bits and rows of the largest rectangle a method makes.
constexpr int largestExtent(Method method) {
    return method == Method::None ? 1 : method == Method::Greedy ? 16 : 8;
}

}  // namespace terrane::mesh
