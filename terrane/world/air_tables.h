// Light at a point of the air, by its altitude and the elevation of the light, from two tables that the first
// call makes in some 10 ms. Any thread.
#pragma once

#include <glm/vec3.hpp>

#include "terrane/world/air.h"

namespace terrane::world {

// For a light of irradiance 1 above the air.
struct AirLight {
    glm::vec3 direct;  // irradiance of the light that is left there
    glm::vec3 around;  // mean radiance of light that was scattered at least once, from all sides
};
// `altitude`: 0 … kAirTop. `sine`: of the light's elevation there.
AirLight airLight(float altitude, float sine);

}  // namespace terrane::world
