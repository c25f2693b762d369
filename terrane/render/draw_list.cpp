#include "terrane/render/draw_list.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

#include "terrane/base/profile.h"
#include "terrane/shared/hash.h"

namespace terrane::render {
namespace {

struct Box {
    glm::vec3 min, max;
};

struct VisibleRegion {
    world::ChunkPos pos;
    const ChunkQuads* chunk;
    const mesh::RegionMesh* quads;
    glm::vec3 origin;  // of the chunk, from the corner of the camera's chunk
    Box box;
    float distance;  // squared
};

float blocksBetween(std::int32_t fromChunk, std::int32_t toChunk) {
    return static_cast<float>((std::int64_t{toChunk} - fromChunk) * world::kChunkSize);
}

// Keeps the colours of the aggregation view where they are while the camera moves.
float chunkNumber(world::ChunkPos pos) {
    const auto x = static_cast<std::uint32_t>(pos.x), y = static_cast<std::uint32_t>(pos.y);
    return static_cast<float>(shared::hash2(x, y, 0) >> 16);
}

// Regions are cells of equal size: in the order of their middles' distances none comes before one that hides
// it. With the boxes of their quads, which differ in height, that would not hold.
std::vector<VisibleRegion> visibleRegions(const QuadStore& quads, world::ChunkPos centre,
                                          const ViewMatrices& view) {
    const Frustum frustum = frustumOf(view.viewProjection);
    std::vector<VisibleRegion> visible;
    for (const auto& [pos, chunk] : quads.chunks()) {
        const glm::vec3 origin(blocksBetween(centre.x, pos.x), blocksBetween(centre.y, pos.y), 0.0f);
        const float height =
            static_cast<float>(world::kChunkHeight) / static_cast<float>(chunk.regions.size());
        glm::vec3 middle = origin + glm::vec3(8, 8, -0.5f * height);
        for (const mesh::RegionMesh& region : chunk.regions) {
            middle.z += height;
            const Box box{origin + glm::vec3(0, 0, region.minZ), origin + glm::vec3(16, 16, region.maxZ)};
            if (region.minZ == region.maxZ || !mayBeVisible(frustum, box.min, box.max)) continue;
            const glm::vec3 toMiddle = middle - view.cameraPosition;
            visible.push_back({pos, &chunk, &region, origin, box, glm::dot(toMiddle, toMiddle)});
        }
    }
    return visible;
}

void sortNearestFirst(std::vector<VisibleRegion>& regions) {
    const auto key = [](const VisibleRegion& r) {
        return std::tuple(r.distance, r.origin.x, r.origin.y, r.quads->minZ);
    };
    std::sort(regions.begin(), regions.end(),
              [&](const VisibleRegion& a, const VisibleRegion& b) { return key(a) < key(b); });
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
void addRegion(DrawList& list, const VisibleRegion& region, glm::vec3 camera) {
    const auto record = static_cast<std::uint32_t>(list.records.size());
    list.records.push_back({glm::vec4(region.origin, chunkNumber(region.pos))});
    ++list.regionCount;
    for (int context = 0; context < mesh::kContextCount; ++context) {
        auto& commands = list.commands[static_cast<std::size_t>(context)];
        mesh::QuadRange pending;
        const auto flush = [&] {
            addCommands(commands, region.chunk->first + pending.first, pending.count, record);
        };
        for (int group = 0; group < mesh::kGroupCount; ++group) {
            const mesh::QuadRange range = region.quads->groups[context][group];
            if (range.count == 0 || !facesCamera(group, region.box, camera)) continue;
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
    std::vector<VisibleRegion> regions = visibleRegions(quads, cameraChunk(camera), view);
    sortNearestFirst(regions);
    for (const VisibleRegion& region : regions) addRegion(list, region, view.cameraPosition);
    for (int context = 0; context < mesh::kContextCount; ++context) {
        if (mesh::contextAlphaClass(context) != mesh::AlphaClass::Blended) continue;
        auto& commands = list.commands[static_cast<std::size_t>(context)];
        std::reverse(commands.begin(), commands.end());
    }
}

}  // namespace terrane::render
