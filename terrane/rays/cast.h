// Casts many rays, one after the other, in code compiled for the instructions of the CPU. Each hit equals
// that of shared::castRay() to the bit. Any thread may call it.
#pragma once

#include <span>

#include "terrane/shared/ray_cast.h"

namespace terrane::rays {

// `hits` has the size of `rays`.
void castRays(shared::RayWords scene, std::span<const shared::Ray> rays, std::span<shared::RayHit> hits);

}  // namespace terrane::rays
