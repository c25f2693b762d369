// The light on what the player holds.
#pragma once

#include <glm/vec3.hpp>

#include "terrane/game/session.h"

namespace terrane::app {

// As the screen shows it, 0…1: daylight of the sky, and lamps, in the block of the eye. As shading does it,
// without its details.
glm::vec3 lightOnHand(const game::Session& session, const glm::dvec3& eyes);

}  // namespace terrane::app
