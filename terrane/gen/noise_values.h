// Results of noise calls that return several values: see Pass (pass.h).
#pragma once

#include "terrane/gen/expr_vec.h"

namespace terrane::gen {

struct Voronoi2D {
    Float distance;  // blocks
    Float ratio;     // nearest / second nearest, 0…1
    IVec2 offset;    // blocks, to the nearest point
};

struct Voronoi3D {
    Float distance;  // blocks, by the call's metric
    Float ratio;     // nearest / second nearest, 0…1
    IVec3 offset;    // blocks, to the nearest point
};

// A wave's phase as a point of the unit disc; nearer to its middle where waves meet.
struct Stripes2D {
    Float cosine, sine;
};

}  // namespace terrane::gen
