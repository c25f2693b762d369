#include "terrane/world/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

namespace terrane::world {

namespace {

// The nearest 32-bit number; the conversion of others is undefined.
std::int32_t floorToInt(double v) {
    constexpr std::numeric_limits<std::int32_t> kRange;
    return static_cast<std::int32_t>(std::clamp<double>(std::floor(v), kRange.min(), kRange.max()));
}

}  // namespace

ChunkPos chunkOf(const glm::dvec3& position) {
    return {floorToInt(position.x / kChunkSize), floorToInt(position.y / kChunkSize)};
}

BlockPos blockOf(const glm::dvec3& position) {
    return {floorToInt(position.x), floorToInt(position.y), floorToInt(position.z)};
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
