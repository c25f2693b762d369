#include "apps/terrane/window/fly_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace terrane::app {
namespace {

// A block short of the last chunk on each side, so that the camera's chunk is always in the world.
constexpr double kEdge = 2147483600.0;

}  // namespace

void turn(render::Camera& camera, double right, double down) {
    camera.yaw = std::remainder(camera.yaw - static_cast<float>(right) * kMouseSensitivity, 360.0f);
    camera.pitch = std::clamp(camera.pitch - static_cast<float>(down) * kMouseSensitivity, -89.9f, 89.9f);
}

void fly(render::Camera& camera, const FlyKeys& keys, float seconds) {
    const auto axis = [](bool positive, bool negative) {
        return static_cast<float>(positive) - static_cast<float>(negative);
    };
    const glm::vec3 motion = render::lookDirection(camera) * axis(keys.forward, keys.back) +
                             render::rightDirection(camera) * axis(keys.right, keys.left) +
                             glm::vec3(0, 0, axis(keys.up, keys.down));
    if (glm::dot(motion, motion) < 1e-6f) return;
    camera.position += glm::dvec3(glm::normalize(motion) * (kFlySpeed * seconds));
    camera.position.x = std::clamp(camera.position.x, -kEdge, kEdge);
    camera.position.y = std::clamp(camera.position.y, -kEdge, kEdge);
    camera.position.z = std::clamp(camera.position.z, -64.0, 1024.0);
}

}  // namespace terrane::app
