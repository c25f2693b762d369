// Position and direction of players and cameras.
#pragma once

#include <glm/vec3.hpp>

#include "terrane/world/coords.h"

namespace terrane::world {

struct Pose {
    glm::dvec3 position{0.0};  // of the eyes; blocks in the world; doubles are exact to 2^-21 block at ±2^31
    float yaw = 0;             // degrees; 0 looks along +x, 90 along +y
    float pitch = 0;           // degrees; 90 looks straight up

    bool operator==(const Pose&) const = default;
};

ChunkPos chunkOf(const glm::dvec3& position);
BlockPos blockOf(const glm::dvec3& position);  // the block that it lies in
glm::vec3 lookDirection(float yaw, float pitch);
glm::vec3 rightDirection(float yaw);

}  // namespace terrane::world
