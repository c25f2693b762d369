// What one hears at a place without doing anything: wind and water.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::game {

struct Ambience {
    float wind = 0, water = 0;          // volumes, 0 to 1
    std::optional<glm::dvec3> waterAt;  // the nearest surface; none: all around, or no water
};

// Wind grows with height, and where less of the sky is covered. Water is heard from its surface within
// kWaterReach blocks, louder where it flows. Looks at some 1,500 blocks: a few times a second is enough.
constexpr int kWaterReach = 12;
Ambience ambienceAt(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& ears);

}  // namespace terrane::game
