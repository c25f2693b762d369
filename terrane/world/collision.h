// Moves a box among blocks, which stop it. Called on the thread that owns the world.
//
// Moves axis by axis, each in one sweep over all blocks on the way, so that no speed takes a box through a
// block. Chunks that are not loaded count as full.
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

// The distance that `box` moves by `motion` (cut to kMaxMotion along each axis): first up or down, then along
// x, then y. Stops kSkin before an obstacle. A box that is already inside a block can leave it.
Sweep sweep(const World& world, const BlockRegistry& blocks, const Aabb& box, glm::dvec3 motion);
constexpr double kMaxMotion = 64, kSkin = 1.0 / 4096;

// Whether a collision box of a block overlaps the box; touching does not count.
bool collides(const World& world, const BlockRegistry& blocks, const Aabb& box);

// Whether the point is in a liquid. The cell of a source counts as full, that of flowing liquid up to its
// surface.
bool isInLiquid(const World& world, const BlockRegistry& blocks, glm::dvec3 point);

}  // namespace terrane::world
