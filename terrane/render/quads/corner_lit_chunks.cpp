#include "terrane/render/quads/corner_lit_chunks.h"

#include <algorithm>

namespace terrane::render {

void CornerLitChunks::markChanged(world::ChunkPos pos, const mesh::MeshSectionSet& meshSections) {
    const auto found = chunks_.find(pos);
    if (found == chunks_.end() || found->second.mesh.meshSections.empty() || meshSections.isEmpty()) return;
    if (found->second.changed.isEmpty()) changed_.push_back(pos);
    found->second.changed |= meshSections;
}

void CornerLitChunks::setMesh(world::ChunkPos pos, const mesh::ChunkMesh& mesh,
                              const mesh::MeshSectionSet& meshSections) {
    Chunk& chunk = chunks_[pos];
    chunk.mesh = mesh::withMeshSections(chunk.mesh, mesh, meshSections);
    if (chunk.changed.isEmpty()) changed_.push_back(pos);
    chunk.changed |= meshSections;
}

// The light of a brick reaches faces one block beyond it.
void CornerLitChunks::setLight(world::ChunkPos pos, const light::ChunkLight& light,
                               const world::SectionSet& bricks) {
    Chunk& chunk = chunks_[pos];
    mesh::MeshSectionSet lit;
    const world::Heights heights = light.heights();
    for (int number = heights.firstSection(); number < heights.endSection(); ++number) {
        const bool isSame =
            chunk.light && (!bricks.has(number) || chunk.light->brick(number) == light.brick(number));
        if (isSame) continue;
        for (int part = std::max(2 * number - 1, heights.bottom >> 3);
             part <= std::min(2 * number + 2, (heights.top >> 3) - 1); ++part)
            lit.add(part);
    }
    chunk.light = light;
    markAround(pos, lit);
}

void CornerLitChunks::markAround(world::ChunkPos pos, const mesh::MeshSectionSet& meshSections) {
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) markChanged(world::offsetBy(pos, x, y), meshSections);
}

void CornerLitChunks::removeMesh(world::ChunkPos pos) {
    const auto found = chunks_.find(pos);
    if (found == chunks_.end()) return;
    found->second.mesh = {};
    found->second.changed = {};
}

void CornerLitChunks::remove(world::ChunkPos pos) {
    const auto found = chunks_.find(pos);
    if (found == chunks_.end()) return;
    const bool wasLit = found->second.light.has_value();
    chunks_.erase(found);
    if (wasLit) markAround(pos, mesh::kAllMeshSections);
}

const mesh::ChunkMesh* CornerLitChunks::meshOf(world::ChunkPos pos) const {
    const auto found = chunks_.find(pos);
    return found == chunks_.end() || found->second.mesh.meshSections.empty() ? nullptr : &found->second.mesh;
}

void CornerLitChunks::clearMeshes() {
    for (auto& [pos, chunk] : chunks_) {
        chunk.mesh = {};
        chunk.changed = {};
    }
    changed_.clear();
}

LitMesh CornerLitChunks::lit(world::ChunkPos pos, const mesh::MeshSectionSet& meshSections,
                             std::span<const shared::ShapeFace> shapeFaces, Splitting splitting) const {
    LightAround around{};
    for (int k = 0; k < 9; ++k) {
        const auto beside = chunks_.find(world::offsetBy(pos, k % 3 - 1, k / 3 - 1));
        if (beside != chunks_.end() && beside->second.light)
            around[static_cast<std::size_t>(k)] = &*beside->second.light;
    }
    const mesh::ChunkMesh part = mesh::withMeshSections({}, chunks_.at(pos).mesh, meshSections);
    return litAtCorners(part, around, shapeFaces, splitting);
}

CornerLitChunks::Change CornerLitChunks::light(world::ChunkPos pos,
                                               std::span<const shared::ShapeFace> shapeFaces) {
    const mesh::MeshSectionSet changed = std::exchange(chunks_[pos].changed, {});
    return {pos, changed, lit(pos, changed, shapeFaces, Splitting::On)};
}

CornerLitChunks::Change CornerLitChunks::unsplit(const Change& change,
                                                 std::span<const shared::ShapeFace> shapeFaces) const {
    return {change.pos, change.meshSections,
            lit(change.pos, change.meshSections, shapeFaces, Splitting::Off)};
}

std::optional<CornerLitChunks::Change> CornerLitChunks::lightNext(
    std::span<const shared::ShapeFace> shapeFaces) {
    while (!changed_.empty()) {
        const world::ChunkPos pos = changed_.front();
        changed_.pop_front();
        const auto found = chunks_.find(pos);
        if (found != chunks_.end() && !found->second.changed.isEmpty()) return light(pos, shapeFaces);
    }
    return std::nullopt;
}

}  // namespace terrane::render
