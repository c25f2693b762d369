// The light and the sky at a time of day: pure functions, any thread. Colors come from the model of the air
// (air.h); a response curve of the eye, which sees in twilight too, turns them into screen colors.
#pragma once

#include <glm/vec3.hpp>

#include "terrane/world/sky_light.h"

namespace terrane::world {

// Colors are linear; 1 is a white surface in full sunlight at noon, roughly.
struct Environment {
    glm::vec3 lightDirection;  // to the sun by day, to the moon at night; unit length
    glm::vec3 lightColor;      // 0 where the light is under the horizon
    glm::vec3 ambientColor;    // of a level surface under the open sky alone
    glm::vec3 zenithColor;     // of the sky straight above
    glm::vec3 horizonColor;    // of the sky near the horizon, mean of all sides
    glm::vec3 glowColor;       // added to the sky near the horizon under the light
    glm::vec3 discColor;       // of the sun or moon itself
    float discRadius;          // of the sun or moon, radians
    bool isMoon;               // the light is the moon
    float starTurn;            // of the stars around the sky, 0…1 a day
    float starLight;           // brightness of the stars, 0 by day … 1 at night
    float lampShare;           // of lamp light that full daylight hides, 0 at night … 0.8
};

// timeDay: 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk; only its fraction counts.
Environment environmentAt(float timeDay);

// Color of the sky in a direction (unit length, z ≥ 0), for the light's direction.
glm::vec3 skyColor(glm::vec3 direction, glm::vec3 toLight, bool isMoon);
// The same for the whole sky, with the sine of the light's elevation. Takes some 2 ms.
SkyTable skyColorTable(float sine, bool isMoon);
// Green of Environment::ambientColor for that light.
float ambientGreen(float sine, bool isMoon);

}  // namespace terrane::world
