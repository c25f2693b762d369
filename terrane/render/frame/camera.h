// A camera in the world and its matrices. All functions are pure; any thread may call them.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "terrane/world/coords.h"

namespace terrane::render {

struct Camera {
    glm::dvec3 position{0.0};  // blocks in the world; doubles are exact to 2^-21 block at ±2^31
    float yaw = 0;             // degrees; 0 looks along +x, 90 along +y
    float pitch = 0;           // degrees; 90 looks straight up
    float fieldOfView = 70;    // degrees, vertical
};

world::ChunkPos cameraChunk(const Camera& camera);
glm::vec3 lookDirection(const Camera& camera);
glm::vec3 rightDirection(const Camera& camera);

// Returns the lowest corner of a chunk of level 0, in blocks in the world.
glm::dvec3 cornerOfChunk(world::ChunkPos chunk);

constexpr float kNearPlane = 0.05f;  // blocks

// In blocks from the corner of the camera's chunk at z = 0.
struct ViewMatrices {
    glm::vec3 cameraPosition;
    glm::mat4 viewProjection;  // reversed depth without far plane: 1 at the near plane, 0 at infinity
    // From the camera to the middle of the image one block ahead, and from there to its right and upper
    // edges.
    glm::vec3 ahead, across, up;
};

ViewMatrices viewMatrices(const Camera& camera, float aspect);

// Returns the width of an image divided by its height, in pixels.
inline float aspectOf(glm::ivec2 size) {
    return static_cast<float>(size.x) / static_cast<float>(size.y);
}

// Half spaces a·p + w ≥ 0 that contain the view: left, right, bottom, top, near.
using Frustum = std::array<glm::vec4, 5>;
Frustum frustumOf(const glm::mat4& viewProjection);
// Returns false only if no point of the box can be visible.
bool mayBeVisible(std::span<const glm::vec4> planes, glm::vec3 min, glm::vec3 max);

}  // namespace terrane::render
