// Tests whether blocks hide a point from the camera, for overlays. On the thread that owns the world.
#pragma once

#include <optional>

#include "terrane/world/ray_cast.h"

namespace terrane::app {

// Glass, liquids and plants hide nothing, nor does the block `own`.
bool isInSight(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& eye,
               const glm::dvec3& point, std::optional<world::BlockPos> own = std::nullopt);

}  // namespace terrane::app
