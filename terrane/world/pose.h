// Position and direction of players and cameras.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>

#include "terrane/world/coords.h"

namespace terrane::world {

struct Pose {
    glm::dvec3 position{0.0};  // of the eyes; blocks in the world; doubles are exact to 2^-21 block at ±2^31
    float yaw = 0;             // degrees; 0 looks along +x, 90 along +y
    float pitch = 0;           // degrees; 90 looks straight up

    bool operator==(const Pose&) const = default;
};

// The chunk and the block that a position lies in. Beyond the world it is the nearest one that has 32-bit
// coordinates; such a chunk is not in the world. No coordinate is NaN.
ChunkPos chunkOf(const glm::dvec3& position);
BlockPos blockOf(const glm::dvec3& position);
glm::vec3 lookDirection(float yaw, float pitch);
glm::vec3 rightDirection(float yaw);

// The figure of a player at one moment: its position, its directions, the phase of its walk.
// game::FigureMotion makes this plain value, and render draws it.
struct Figure {
    glm::dvec3 eyes{0};      // blocks; kEyeHeight above the feet
    float yaw = 0;           // degrees, of the head, as in Pose
    float pitch = 0;         // degrees
    float bodyYaw = 0;       // degrees
    float stride = 0;        // radians: phase of the legs, 2π is two steps
    float strideSize = 0;    // 0 stands … 1 runs
    float swing = 0;         // of the right arm: 0 at rest, else the finished share of the swing
    std::uint32_t look = 0;  // colors and hair follow from it
};

}  // namespace terrane::world
