#include "terrane/world/pose.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

namespace terrane::world {

ChunkPos chunkOf(const glm::dvec3& position) {
    return {static_cast<std::int32_t>(std::floor(position.x / kChunkSize)),
            static_cast<std::int32_t>(std::floor(position.y / kChunkSize))};
}

BlockPos blockOf(const glm::dvec3& position) {
    const glm::dvec3 corner = glm::floor(position);
    return {static_cast<std::int32_t>(corner.x), static_cast<std::int32_t>(corner.y),
            static_cast<std::int32_t>(corner.z)};
}

glm::vec3 lookDirection(float yaw, float pitch) {
    const float y = glm::radians(yaw), p = glm::radians(pitch);
    return {std::cos(y) * std::cos(p), std::sin(y) * std::cos(p), std::sin(p)};
}

glm::vec3 rightDirection(float yaw) {
    const float y = glm::radians(yaw);
    return {std::sin(y), -std::cos(y), 0.0f};
}

}  // namespace terrane::world
