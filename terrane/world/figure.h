// The figure of a player at one moment: its place, its directions, the phase of its walk. Plain value, made
// by game::FigureMotion, drawn by render.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace terrane::world {

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
