// Points scattered over the plane for things that stand apart from each other, like trees.
#pragma once

#include <string_view>

#include "terrane/gen/pass.h"

namespace terrane::gen {

struct ScatterPoint {
    Bool isHere;  // whether a point lies in this column
    IVec2 at;     // its block: the position for random numbers, so that all levels agree
    Int hash;     // 0…2^24−1, by point
};

constexpr int kMaxScatterSpacing = 1024;

// One point in each square of `spacing` blocks; rows of squares are shifted by chance, so that no columns of
// points show. Any two are minDistance blocks or more apart along x or along y. A point depends on its own
// square alone, so that neighbors and levels agree; of several points in a wide column the first one counts,
// which never happens where minDistance is at least the step. 1 ≤ minDistance ≤ spacing ≤ 1024.
ScatterPoint scatter(Pass& p, std::string_view name, int spacing, int minDistance);

}  // namespace terrane::gen
