// Shapes of a fill: which blocks of a box it sets. A shape is a predicate over the blocks of a box, so
// limits, claims, undo steps and histories are those of a fill of the whole box. Plain values and pure
// functions.
#pragma once

#include <cstdint>

#include "terrane/world/coords.h"

namespace terrane::game {

enum class ShapeKind : std::uint8_t {
    Solid,
    Hollow,  // the outer layer of all six sides; the blocks inside stay
    Walls,   // the outer layer of the four sides; floor and ceiling stay open
    Sphere,  // the ellipsoid that touches all six sides
    Line,    // from a corner to the opposite one; each block touches the next, at least at a corner
    Count
};

struct FillShape {
    ShapeKind kind = ShapeKind::Solid;
    // A line rises from the bottom of the box to its top. It begins at the lowest x and y, or at the highest.
    bool fromHighX = false, fromHighY = false;

    bool operator==(const FillShape&) const = default;
};

// Returns the line of a box with corners `a` and `b` that goes from one to the other, in either order.
FillShape lineBetween(world::BlockPos a, world::BlockPos b);

// Returns whether the shape has a block of the box. The box has at most world::kMaxStructureBlocks blocks.
bool contains(const FillShape& shape, const world::BlockBox& box, world::BlockPos pos);

}  // namespace terrane::game
