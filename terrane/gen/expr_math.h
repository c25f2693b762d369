// Powers, logarithms and angles of expressions, made of their additions, multiplications and bits, so that
// both back ends and constant folding give the same value to the bit without knowing of them.
//
// The polynomials are least-maximum fits on the intervals named in expr_math.cpp; the errors stated here are
// measured against the C library in double precision (tests/gen/expr_math_test.cpp).
#pragma once

#include "terrane/gen/expr.h"

namespace terrane::gen {

// 2^x within 1.5 units in the last place for x in -126…128; 0 below, 2^128 less a little above.
Float exp2(Float x);
// Within 2.5 units in the last place of the larger of the result and 1/8, for x ≥ 2^-126; -10^9 for smaller
// ones, 0 and negative numbers: exp2 makes 0 of it again.
Float log2(Float x);
// x^y = exp2(y · log2(x)) for x ≥ 0, within a relative error of (2 + |y log2 x|) · 2^-23; 0 for negative x
// and y > 0, 1 for y = 0.
Float pow(Float x, Float y);
// Radians. Within 2^-23 for |x| ≤ 10,000; beyond, less and less of it is left, the same everywhere.
Float sin(Float x);
Float cos(Float x);

// A color as an integer: red · 2^16 + green · 2^8 + blue (world/tint.h). Each is 0…1, sRGB; others are
// clamped.
Int packColor(Float red, Float green, Float blue);

}  // namespace terrane::gen
