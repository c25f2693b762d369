// Ambient sounds at a place: wind and water.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::game {

struct Ambience {
    float wind = 0, water = 0;          // volumes, 0 to 1
    std::optional<glm::dvec3> waterAt;  // the nearest surface; none: under water, or no water
};

// Wind grows with height and with the share of open sky. Water is heard within kWaterReach blocks of its
// surface, louder where it flows. Reads up to 2,200 blocks: a few times a second is enough.
constexpr int kWaterReach = 12;
Ambience ambienceAt(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& ears);

}  // namespace terrane::game
