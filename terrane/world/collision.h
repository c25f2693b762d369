// A box that moves among blocks: what stops it. Called by whoever moves players and things, on the thread
// that owns the world.
//
// Axis by axis, each in one sweep over all blocks on the way: however fast a box is, it never passes through
// a block. What is not loaded stops it as well: nobody knows what is there.
#pragma once

#include <glm/vec3.hpp>

#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::world {

// Blocks; exact to 2^-22 at the edge of the world.
struct Aabb {
    glm::dvec3 min{0}, max{1};
};

struct Sweep {
    glm::dvec3 moved{0};
    glm::bvec3 blocked{false};  // by axis: less far than asked for
};

// How far `box` gets by `motion` (at most kMaxMotion along each axis, the rest is cut off): first up or down,
// then along x, then y. Stops kSkin before what it meets. A box that is inside of a block already can leave
// it.
Sweep sweep(const World& world, const BlockRegistry& blocks, const Aabb& box, glm::dvec3 motion);
constexpr double kMaxMotion = 64, kSkin = 1.0 / 4096;

// Whether something that collides is inside of the box; touching is not.
bool collides(const World& world, const BlockRegistry& blocks, const Aabb& box);

// Whether the point is in a liquid. The cell of a source counts as full, of what flows only what is filled.
bool isInLiquid(const World& world, const BlockRegistry& blocks, glm::dvec3 point);

}  // namespace terrane::world
