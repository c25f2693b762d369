// The deterministic division and square root of terrane/shared/det_math.h, by the names the generator's code
// uses.
#pragma once

#include "terrane/shared/det_math.h"

namespace terrane::gen {

using shared::detDivide;
using shared::detReciprocal;
using shared::detSqrt;
using shared::kInverseRootMagic;
using shared::kReciprocalMagic;

}  // namespace terrane::gen
