#include "terrane/render/shadow/shadow_volume.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "terrane/mesh/draw_bucket.h"
#include "terrane/render/shadow/shadow_casters.h"
#include "terrane/render/shadow/shadow_clipmap.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {
namespace {

std::size_t castingQuads(const mesh::MeshSection& meshSection, glm::vec3 light) {
    std::size_t count = 0;
    for (int bucket = 0; bucket < mesh::kDrawBucketCount; ++bucket) {
        if (mesh::bucketAlphaClass(bucket) == mesh::AlphaClass::Blended) continue;
        for (int direction = 0; direction < mesh::kFaceDirectionCount; ++direction) {
            if (facesLight(direction, light)) count += meshSection.ranges[bucket][direction].count;
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
    // A pyramid that ends `reach` blocks ahead, not at that distance around the camera: it contains the cap
    // between its edges.
    for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
        cover(view.cameraPosition + reach * (view.ahead + corner.x * view.across + corner.y * view.up));
    }
    return volume;
}

bool mayBeInVolume(const ShadowVolume& volume, glm::vec3 boxMin, glm::vec3 boxMax) {
    // The box in the light's axes: its middle, and its half extent along each.
    const glm::vec3 middle = volume.toLight * (0.5f * (boxMin + boxMax)), half = 0.5f * (boxMax - boxMin);
    const glm::mat3& m = volume.toLight;
    const glm::vec3 reach = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z;
    const glm::vec3 low = middle - reach, high = middle + reach;
    return high.x >= volume.min.x && low.x <= volume.max.x && high.y >= volume.min.y &&
           low.y <= volume.max.y && high.z >= volume.farthest;
}

std::array<glm::dvec3, 8> nearShadowBox(const Camera& camera, glm::vec3 lightDirection) {
    const glm::dmat3 axes = glm::transpose(shadowPlane(cameraChunk(camera), lightDirection).toLight);
    const double reach = 0.5 * shared::kShadowTiles * shadowTileBlocks(0);
    std::array<glm::dvec3, 8> corners;
    for (int k = 0; k < 8; ++k) {
        const glm::dvec3 side(k & 1, k >> 1 & 1, k >> 2);
        corners[static_cast<std::size_t>(k)] = camera.position + axes * ((2.0 * side - 1.0) * reach);
    }
    return corners;
}

std::size_t countShadowTriangles(const QuadStore& quads, const Camera& camera, const ViewMatrices& view,
                                 glm::vec3 lightDirection) {
    const ShadowVolume volume = shadowVolume(view, lightDirection, kShadowReach);
    const world::ChunkPos center = cameraChunk(camera);
    std::size_t count = 0;
    for (const auto& [pos, chunk] : quads.chunks()) {
        const glm::vec2 corner = shared::chunkCorner({pos.x, pos.y}, pos.level, {center.x, center.y});
        const float width = world::kChunkSize * shared::columnBlocks(pos.level);
        for (const mesh::MeshSection& meshSection : chunk) {
            const glm::vec3 min(corner, meshSection.minZ), max(corner + width, meshSection.maxZ);
            if (mayBeInVolume(volume, min - shared::kWaving, max + shared::kWaving))
                count += 2 * castingQuads(meshSection, lightDirection);
        }
    }
    return count;
}

}  // namespace terrane::render
