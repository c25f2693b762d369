#include "terrane/render/draw_list.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "terrane/base/profile.h"

namespace terrane::render {
namespace {

struct VisibleChunk {
    const ChunkQuads* quads;
    glm::vec3 origin;  // from the corner of the camera's chunk
    float distance;
};

struct Box {
    glm::vec3 min, max;
};

std::vector<VisibleChunk> chunksNearestFirst(const QuadStore& quads, world::ChunkPos centre,
                                             glm::vec3 cameraPosition) {
    std::vector<VisibleChunk> chunks;
    chunks.reserve(quads.chunks().size());
    for (const auto& [pos, chunkQuads] : quads.chunks()) {
        const glm::vec3 origin(static_cast<float>((pos.x - centre.x) * world::kChunkSize),
                               static_cast<float>((pos.y - centre.y) * world::kChunkSize), 0.0f);
        const glm::vec2 toMiddle = glm::vec2(origin) + 8.0f - glm::vec2(cameraPosition);
        chunks.push_back({&chunkQuads, origin, glm::dot(toMiddle, toMiddle)});
    }
    std::sort(chunks.begin(), chunks.end(), [](const VisibleChunk& a, const VisibleChunk& b) {
        if (a.distance != b.distance) return a.distance < b.distance;
        return std::pair(a.origin.x, a.origin.y) < std::pair(b.origin.x, b.origin.y);
    });
    return chunks;
}

// False where every face of the group in the box is seen from behind.
bool facesCamera(int group, const Box& box, glm::vec3 camera) {
    switch (group) {
        case world::kFaceNegX:
            return camera.x < box.max.x;
        case world::kFacePosX:
            return camera.x > box.min.x;
        case world::kFaceNegY:
            return camera.y < box.max.y;
        case world::kFacePosY:
            return camera.y > box.min.y;
        case world::kFaceNegZ:
            return camera.z < box.max.z;
        case world::kFacePosZ:
            return camera.z > box.min.z;
        default:
            return true;
    }
}

void addCommands(std::vector<DrawCommand>& commands, std::uint32_t first, std::uint32_t count,
                 std::uint32_t record) {
    while (count > 0) {
        const std::uint32_t part = std::min(count, kMaxQuadsPerCommand);
        commands.push_back({6 * part, 1, 0, static_cast<std::int32_t>(4 * first), record});
        first += part;
        count -= part;
    }
}

// Groups lie one after the other: neighbouring ones that face the camera are drawn by one command.
void addRegion(DrawList& list, const VisibleChunk& chunk, const mesh::RegionMesh& region, glm::vec3 camera) {
    const Box box{chunk.origin + glm::vec3(0, 0, region.minZ), chunk.origin + glm::vec3(16, 16, region.maxZ)};
    const auto record = static_cast<std::uint32_t>(list.records.size());
    list.records.push_back({glm::vec4(chunk.origin, 0.0f)});
    ++list.regionCount;
    for (int context = 0; context < mesh::kContextCount; ++context) {
        auto& commands = list.commands[static_cast<std::size_t>(context)];
        mesh::QuadRange pending;
        const auto flush = [&] {
            addCommands(commands, chunk.quads->first + pending.first, pending.count, record);
        };
        for (int group = 0; group < mesh::kGroupCount; ++group) {
            const mesh::QuadRange range = region.groups[context][group];
            if (range.count == 0 || !facesCamera(group, box, camera)) continue;
            list.quadCount += range.count;
            if (pending.count > 0 && pending.first + pending.count == range.first) {
                pending.count += range.count;
                continue;
            }
            flush();
            pending = range;
        }
        flush();
    }
}

}  // namespace

void buildDrawList(DrawList& list, const QuadStore& quads, const Camera& camera, const ViewMatrices& view) {
    TERRANE_ZONE("draw list");
    for (auto& commands : list.commands) commands.clear();
    list.records.clear();
    list.quadCount = list.regionCount = 0;
    const Frustum frustum = frustumOf(view.viewProjection);
    for (const VisibleChunk& chunk : chunksNearestFirst(quads, cameraChunk(camera), view.cameraPosition)) {
        for (const mesh::RegionMesh& region : chunk.quads->regions) {
            if (region.minZ == region.maxZ) continue;
            const glm::vec3 min = chunk.origin + glm::vec3(0, 0, region.minZ);
            const glm::vec3 max = chunk.origin + glm::vec3(16, 16, region.maxZ);
            if (mayBeVisible(frustum, min, max)) addRegion(list, chunk, region, view.cameraPosition);
        }
    }
    for (int context = 0; context < mesh::kContextCount; ++context) {
        if (mesh::contextAlphaClass(context) != mesh::AlphaClass::Blended) continue;
        auto& commands = list.commands[static_cast<std::size_t>(context)];
        std::reverse(commands.begin(), commands.end());
    }
}

}  // namespace terrane::render
