// The light and the sky at a time of day: pure functions, any thread.
#pragma once

#include <glm/vec3.hpp>

namespace terrane::world {

// Colors are linear; 1 is a white surface in full sunlight at noon, roughly.
struct Environment {
    glm::vec3 lightDirection;  // to the sun by day, to the moon at night; unit length
    glm::vec3 lightColor;
    glm::vec3 ambientColor;
    glm::vec3 zenithColor;
    glm::vec3 horizonColor;
    glm::vec3 glowColor;  // added to the sky around the light near the horizon
    glm::vec3 discColor;  // of the sun or moon itself
    float discRadius;     // of the sun or moon, radians
    bool isMoon;          // the light is the moon
    float starTurn;       // of the stars around the sky, 0…1 a day
    float starLight;      // brightness of the stars, 0 by day … 1 at night
    float lampShare;      // of lamp light that full daylight hides, 0 at night … 0.8
};

// timeDay: 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk; only its fraction counts.
Environment environmentAt(float timeDay);

}  // namespace terrane::world
