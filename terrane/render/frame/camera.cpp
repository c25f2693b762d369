#include "terrane/render/frame/camera.h"

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include "terrane/world/pose.h"

namespace terrane::render {
namespace {

// Right-handed, depth from 1 at the near plane to 0 at infinity: floats are densest near 0, which is where
// perspective crowds distant depths.
glm::mat4 reversedInfinitePerspective(float fieldOfViewRadians, float aspect) {
    const float f = 1.0f / std::tan(fieldOfViewRadians * 0.5f);
    glm::mat4 m(0.0f);
    m[0][0] = f / aspect;
    m[1][1] = f;
    m[2][3] = -1.0f;
    m[3][2] = kNearPlane;
    return m;
}

}  // namespace

world::ChunkPos cameraChunk(const Camera& camera) {
    return world::chunkOf(camera.position);
}

glm::vec3 lookDirection(const Camera& camera) {
    return world::lookDirection(camera.yaw, camera.pitch);
}

glm::vec3 rightDirection(const Camera& camera) {
    return world::rightDirection(camera.yaw);
}

glm::dvec3 cornerOfChunk(world::ChunkPos chunk) {
    return {double{world::kChunkSize} * chunk.x, double{world::kChunkSize} * chunk.y, 0};
}

ViewMatrices viewMatrices(const Camera& camera, float aspect) {
    ViewMatrices v;
    v.cameraPosition = glm::vec3(camera.position - cornerOfChunk(cameraChunk(camera)));
    const float fieldOfView = glm::radians(camera.fieldOfView), half = std::tan(fieldOfView * 0.5f);
    v.ahead = lookDirection(camera);
    v.across = half * aspect * rightDirection(camera);
    v.up = half * glm::cross(rightDirection(camera), v.ahead);
    const glm::mat4 view = glm::lookAt(v.cameraPosition, v.cameraPosition + v.ahead, v.up);
    v.viewProjection = reversedInfinitePerspective(fieldOfView, aspect) * view;
    return v;
}

// Rows of the matrix combined (G. Gribb, K. Hartmann, Fast Extraction of Viewing Frustum Planes, 2001).
Frustum frustumOf(const glm::mat4& m) {
    const auto row = [&](int r) { return glm::vec4(m[0][r], m[1][r], m[2][r], m[3][r]); };
    return {row(3) + row(0), row(3) - row(0), row(3) + row(1), row(3) - row(1), row(3) - row(2)};
}

bool mayBeVisible(std::span<const glm::vec4> planes, glm::vec3 min, glm::vec3 max) {
    for (const glm::vec4& plane : planes) {
        const glm::vec3 farthest(plane.x > 0 ? max.x : min.x, plane.y > 0 ? max.y : min.y,
                                 plane.z > 0 ? max.z : min.z);
        if (glm::dot(glm::vec3(plane), farthest) + plane.w < 0) return false;
    }
    return true;
}

}  // namespace terrane::render
