#include "terrane/game/fill_shape.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace terrane::game {
namespace {

using world::BlockBox;
using world::BlockPos;

// A block as offsets from the low corner. 64 bits, since a coordinate beside the last one overflows 32.
struct CellInBox {
    std::array<std::int64_t, 3> at, size;
};

CellInBox cellOf(const BlockBox& box, BlockPos pos) {
    return {{std::int64_t{pos.x} - box.low.x, std::int64_t{pos.y} - box.low.y, pos.z - box.low.z},
            {std::int64_t{box.high.x} - box.low.x + 1, std::int64_t{box.high.y} - box.low.y + 1,
             box.high.z - box.low.z + 1}};
}

bool isAtEnd(const CellInBox& cell, std::size_t axis) {
    return cell.at[axis] == 0 || cell.at[axis] == cell.size[axis] - 1;
}

// The middle of the block is in the ellipsoid (x/a)² + (y/b)² + (z/c)² ≤ 1, in exact integers: twice the
// distance from the middle of the box is `d`, and twice a semi-axis is the size. The product of the sizes is
// at most 500,000, so no term exceeds 2.5e11.
bool isInSphere(const CellInBox& cell) {
    const std::int64_t volume = cell.size[0] * cell.size[1] * cell.size[2];
    std::int64_t sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t d = 2 * cell.at[axis] + 1 - cell.size[axis];
        const std::int64_t term = d * (volume / cell.size[axis]);
        sum += term * term;
    }
    return sum <= volume * volume;
}

// The longest axis counts the steps; on each other axis the block is the one nearest to the exact line.
bool isOnLine(const FillShape& shape, CellInBox cell) {
    if (shape.fromHighX) cell.at[0] = cell.size[0] - 1 - cell.at[0];
    if (shape.fromHighY) cell.at[1] = cell.size[1] - 1 - cell.at[1];
    const auto longest = static_cast<std::size_t>(std::ranges::max_element(cell.size) - cell.size.begin());
    const std::int64_t steps = cell.size[longest] - 1, step = cell.at[longest];
    if (steps == 0) return true;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (cell.at[axis] != (2 * step * (cell.size[axis] - 1) + steps) / (2 * steps)) return false;
    return true;
}

}  // namespace

FillShape lineBetween(BlockPos a, BlockPos b) {
    const bool isUp = a.z != b.z ? a.z < b.z : a < b;  // a level line begins at its lowest x, then y
    const BlockPos &bottom = isUp ? a : b, &top = isUp ? b : a;
    return {ShapeKind::Line, bottom.x > top.x, bottom.y > top.y};
}

bool contains(const FillShape& shape, const BlockBox& box, BlockPos pos) {
    const CellInBox cell = cellOf(box, pos);
    switch (shape.kind) {
        case ShapeKind::Solid:
            return true;
        case ShapeKind::Hollow:
            return isAtEnd(cell, 0) || isAtEnd(cell, 1) || isAtEnd(cell, 2);
        case ShapeKind::Walls:
            return isAtEnd(cell, 0) || isAtEnd(cell, 1);
        case ShapeKind::Sphere:
            return isInSphere(cell);
        case ShapeKind::Line:
            return isOnLine(shape, cell);
        case ShapeKind::Count:
            break;
    }
    assert(false && "no kind of a shape");
    return false;
}

}  // namespace terrane::game
