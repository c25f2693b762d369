// The light on the block in the player's hand.
#pragma once

#include <glm/vec3.hpp>

#include "terrane/game/session.h"

namespace terrane::app {

// Display color, 0…1, of daylight and lamps in the block of the eye; a simplified form of the world's
// shading.
glm::vec3 lightOnHand(const game::Session& session, const glm::dvec3& eyes);

}  // namespace terrane::app
