// Chunks of the renderer and their memory budget.
#include <algorithm>

#include "terrane/render/renderer.h"

namespace terrane::render {
namespace {

// Share of the budget for records of mesh sections and draw commands, which grow with the world: quads and
// light leave it free. They take about a twelfth of the size of quads and light.
constexpr std::size_t kRecordsShare = 8;

// Share for the first buffer of quads, which is seldom full.
constexpr std::size_t kFirstQuadsShare = 16;

// Light's share of the memory of quads and light: a chunk of a landscape has 28 KB of light and 8 KB of
// quads.
std::size_t lightShare(std::size_t bytes) {
    return bytes / 4 * 3;
}

}  // namespace

GpuMemory Renderer::memory() const {
    return {.quads = quads_.bufferBytes(),
            .light = light_.textureBytes(),
            .meshSections = meshSections_.gpuBytes() + passes_.cull.gpuBytes(meshSections_),
            .textures = resources_.gpuBytes() + noise_.gpuBytes() + sky_.gpuBytes() + tints_.gpuBytes() +
                        land_.gpuBytes(),
            .targets = targets_.gpuBytes() + passes_.targetBytes(),
            .staging = stagingBytes_};
}

void Renderer::setMemoryBudget(std::size_t bytes) {
    budgetBytes_ = bytes;
    peakBytes_ = 0;
    const std::size_t firstQuads = bytes / kFirstQuadsShare / shared::kQuadBytes;
    quadSizes_.firstQuads =
        static_cast<std::uint32_t>(std::clamp<std::size_t>(firstQuads, 1, QuadStoreSizes().firstQuads));
    clearChunks();
}

// Comes before quads or light may grow: both get the remaining memory.
void Renderer::shareBudget() {
    if (budgetBytes_ == SIZE_MAX) return;
    const GpuMemory used = memory();
    const std::size_t records = std::max(used.meshSections, budgetBytes_ / kRecordsShare);
    const std::size_t taken = used.fixed() + used.quads + used.light + records;
    const std::size_t room = budgetBytes_ - std::min(budgetBytes_, taken);
    quads_.setMaxBytes(used.quads + room);
    light_.setMaxBytes(used.light + room);
}

void Renderer::notePeak() {
    const GpuMemory used = memory();
    const std::size_t others = used.total() - used.quads - used.light;
    peakBytes_ = std::max(peakBytes_, others + quads_.takePeakBytes() + light_.takePeakBytes());
}

void Renderer::showQuads(world::ChunkPos pos, mesh::MeshSectionSet changed) {
    if (!hidden_.contains(pos)) meshSections_.set(pos, quads_.meshSectionsOf(pos), changed);
}

void Renderer::setShown(world::ChunkPos pos, bool isShown) {
    if (isShown) {
        if (hidden_.erase(pos) > 0) showQuads(pos, mesh::kAllMeshSections);
    } else if (hidden_.insert(pos).second) {
        meshSections_.remove(pos);
    }
}

bool Renderer::setChunk(world::ChunkPos pos, const mesh::ChunkMesh& mesh, mesh::MeshSectionSet meshSections) {
    shareBudget();
    const bool hasRoom = quads_.set(pos, mesh, meshSections);
    showQuads(pos, meshSections);
    notePeak();
    return hasRoom;
}

bool Renderer::reserveChunk(world::ChunkPos pos, std::span<const mesh::MeshSection> meshes) {
    shareBudget();
    const bool hasRoom = quads_.reserve(pos, meshes);
    showQuads(pos, mesh::kAllMeshSections);
    notePeak();
    return hasRoom;
}

bool Renderer::setLight(world::ChunkPos pos, const light::ChunkLight& light, std::uint16_t bricks) {
    shareBudget();
    const bool hasRoom = light_.set(pos, light, bricks);
    notePeak();
    return hasRoom;
}

void Renderer::removeChunk(world::ChunkPos pos) {
    meshSections_.remove(pos);
    hidden_.erase(pos);
    quads_.remove(pos);
    light_.remove(pos);
}

void Renderer::setViewDistance(int chunks) {
    viewDistance_ = chunks;
    light_ = {};  // before the new one takes memory
    std::size_t mostBytes = SIZE_MAX;
    if (budgetBytes_ != SIZE_MAX) {
        const GpuMemory used = memory();
        const std::size_t taken = used.fixed() + std::max(used.meshSections, budgetBytes_ / kRecordsShare);
        const std::size_t room = budgetBytes_ - std::min(budgetBytes_, taken);
        mostBytes = std::min(lightShare(room), room - std::min(room, used.quads));
    }
    light_ = LightStore(chunks, 0, mostBytes);
    notePeak();
}

void Renderer::clearChunks() {
    quads_ = QuadStore({.arenaQuads = 1});  // before the new one takes memory
    quads_ = QuadStore(quadSizes_);
    hidden_.clear();
    meshSections_ = MeshSectionTable(quads_.ranges().arenaSize());
    passes_.shadowMap.forget();
    passes_.cull.forget();
    setViewDistance(viewDistance_);
}

}  // namespace terrane::render
