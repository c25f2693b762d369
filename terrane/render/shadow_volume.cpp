#include "terrane/render/shadow_volume.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "terrane/mesh/face_context.h"

namespace terrane::render {
namespace {

glm::mat3 lightAxes(glm::vec3 toward) {
    const glm::vec3 other = std::abs(toward.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    const glm::vec3 across = glm::normalize(glm::cross(other, toward));
    return glm::transpose(glm::mat3(across, glm::cross(toward, across), toward));
}

bool facesLight(int group, glm::vec3 light) {
    if (group == mesh::kGroupAlways) return true;
    const float along = light[group / 2];
    return group % 2 == 0 ? along < 0 : along > 0;
}

std::size_t castingQuads(const mesh::RegionMesh& region, glm::vec3 light) {
    std::size_t count = 0;
    for (int context = 0; context < mesh::kContextCount; ++context) {
        if (mesh::contextAlphaClass(context) == mesh::AlphaClass::Blended) continue;
        for (int group = 0; group < mesh::kGroupCount; ++group) {
            if (facesLight(group, light)) count += region.groups[context][group].count;
        }
    }
    return count;
}

}  // namespace

ShadowVolume shadowVolume(const ViewMatrices& view, glm::vec3 lightDirection, float reach) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    ShadowVolume volume{lightAxes(glm::normalize(lightDirection)), glm::vec2(kInfinity),
                        glm::vec2(-kInfinity), kInfinity};
    const auto cover = [&](glm::vec3 point) {
        const glm::vec3 p = volume.toLight * point;
        volume.min = glm::min(volume.min, glm::vec2(p));
        volume.max = glm::max(volume.max, glm::vec2(p));
        volume.farthest = std::min(volume.farthest, p.z);
    };
    cover(view.cameraPosition);
    const glm::mat4 toWorld = glm::inverse(view.viewProjection);
    for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}, {0, 0}}) {
        const glm::vec4 nearPoint = toWorld * glm::vec4(corner, 1, 1);
        const glm::vec3 direction = glm::normalize(glm::vec3(nearPoint) / nearPoint.w - view.cameraPosition);
        cover(view.cameraPosition + reach * direction);
    }
    return volume;
}

bool mayBeInVolume(const ShadowVolume& volume, glm::vec3 boxMin, glm::vec3 boxMax) {
    // The box in the light's axes: its middle, and how far it reaches along each.
    const glm::vec3 middle = volume.toLight * (0.5f * (boxMin + boxMax)), half = 0.5f * (boxMax - boxMin);
    const glm::mat3& m = volume.toLight;
    const glm::vec3 reach = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z;
    const glm::vec3 low = middle - reach, high = middle + reach;
    return high.x >= volume.min.x && low.x <= volume.max.x && high.y >= volume.min.y &&
           low.y <= volume.max.y && high.z >= volume.farthest;
}

std::size_t countShadowTriangles(const QuadStore& quads, const Camera& camera, const ViewMatrices& view,
                                 glm::vec3 lightDirection) {
    const ShadowVolume volume = shadowVolume(view, lightDirection, kShadowReach);
    const world::ChunkPos centre = cameraChunk(camera);
    std::size_t count = 0;
    for (const auto& [pos, chunk] : quads.chunks()) {
        const glm::vec3 origin(static_cast<float>(std::int64_t{pos.x} - centre.x) * world::kChunkSize,
                               static_cast<float>(std::int64_t{pos.y} - centre.y) * world::kChunkSize, 0);
        for (const mesh::RegionMesh& region : chunk.regions) {
            const glm::vec3 min = origin + glm::vec3(0, 0, region.minZ);
            const glm::vec3 max = origin + glm::vec3(world::kChunkSize, world::kChunkSize, region.maxZ);
            if (mayBeInVolume(volume, min, max)) count += 2 * castingQuads(region, lightDirection);
        }
    }
    return count;
}

}  // namespace terrane::render
