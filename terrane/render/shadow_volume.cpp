#include "terrane/render/shadow_volume.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "terrane/mesh/draw_bucket.h"
#include "terrane/shared/mesh_section.h"

namespace terrane::render {
namespace {

glm::mat3 lightAxes(glm::vec3 toward) {
    const glm::vec3 other = std::abs(toward.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    const glm::vec3 across = glm::normalize(glm::cross(other, toward));
    return glm::transpose(glm::mat3(across, glm::cross(toward, across), toward));
}

bool facesLight(int direction, glm::vec3 light) {
    if (direction == mesh::kAnyDirection) return true;
    const float along = light[direction / 2];
    return direction % 2 == 0 ? along < 0 : along > 0;
}

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
    // A pyramid that ends `reach` blocks ahead, not around the camera: it holds the cap between its edges.
    for (const glm::vec2 corner : {glm::vec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
        cover(view.cameraPosition + reach * (view.ahead + corner.x * view.across + corner.y * view.up));
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

Frustum planesOf(const ShadowVolume& volume) {
    const glm::mat3 axes = glm::transpose(volume.toLight);  // columns: across, up, toward the light
    return {glm::vec4(axes[0], -volume.min.x), glm::vec4(-axes[0], volume.max.x),
            glm::vec4(axes[1], -volume.min.y), glm::vec4(-axes[1], volume.max.y),
            glm::vec4(axes[2], -volume.farthest)};
}

ShadowFit fitShadowMap(const Camera& camera, float aspect, glm::vec3 lightDirection, int texels) {
    const float half = std::tan(glm::radians(camera.fieldOfView) * 0.5f);
    const float corner = std::atan(half * std::sqrt(1 + aspect * aspect));  // from the view's axis
    const bool isWide = corner > glm::radians(45.0f);
    const float radius = isWide ? kShadowReach * std::sin(corner) : kShadowReach / (2 * std::cos(corner));
    const float ahead = isWide ? kShadowReach * std::cos(corner) : radius;

    // Texels are counted from a corner of the world that the camera seldom leaves: numbers stay small, and
    // places that are alike have shadows that are.
    constexpr int kAnchorChunks = 64;
    const world::ChunkPos chunk = cameraChunk(camera);
    const glm::vec3 anchor(-world::kChunkSize * (chunk.x & (kAnchorChunks - 1)),
                           -world::kChunkSize * (chunk.y & (kAnchorChunks - 1)), 0);
    const glm::mat3 toLight = lightAxes(glm::normalize(lightDirection));
    const glm::vec3 middle = viewMatrices(camera, aspect).cameraPosition + ahead * lookDirection(camera);
    const float texel = 2 * radius / static_cast<float>(texels - 1);  // room for the step
    glm::vec3 low = toLight * (middle - anchor) - radius;
    low.x = std::floor(low.x / texel) * texel;
    low.y = std::floor(low.y / texel) * texel;
    low += toLight * anchor;

    const glm::vec3 size(texel * static_cast<float>(texels), texel * static_cast<float>(texels), 2 * radius);
    glm::mat4 toMap(toLight);
    toMap[3] = glm::vec4(-low, 1);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) toMap[column][row] /= size[row];
    }
    return {toMap, texel};
}

std::array<glm::dvec3, 8> cornersOf(const ShadowFit& fit, const Camera& camera) {
    const world::ChunkPos chunk = cameraChunk(camera);
    const glm::dvec3 origin(double{world::kChunkSize} * chunk.x, double{world::kChunkSize} * chunk.y, 0);
    const glm::mat4 fromMap = glm::inverse(fit.toMap);
    std::array<glm::dvec3, 8> corners;
    for (int k = 0; k < 8; ++k) {
        const glm::vec4 at(k & 1, k >> 1 & 1, k >> 2, 1);
        corners[static_cast<std::size_t>(k)] = origin + glm::dvec3(fromMap * at);
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
