// Finds the first block that a ray from the camera hits: the block that a player looks at, breaks or builds
// on. The application and tools call it on the thread that owns the world.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::world {

struct Ray {
    glm::dvec3 origin{0};     // in blocks; exact to 2^-22 at the edge of the world
    glm::dvec3 direction{0};  // of any length but zero
};

struct RayHit {
    BlockPos block;
    Face face = kFacePosZ;  // of the selection box, through which the ray enters
    double distance = 0;    // from the origin, in blocks
};

// Returns the first block whose selection box the ray enters within `maxDistance` blocks. A box around the
// origin is hit at distance 0, on the face through which the ray would have entered it. Chunks that are not
// loaded are passed as air. Returns nothing also for a direction of length zero and for values that are not
// finite. Rays pass liquids, but stop at the sources of `liquid`, if given.
std::optional<RayHit> castRay(const World& world, const BlockRegistry& registry, const Ray& ray,
                              double maxDistance, BlockId liquid = kAir);

}  // namespace terrane::world
