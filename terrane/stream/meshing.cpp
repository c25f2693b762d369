#include "terrane/stream/meshing.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <utility>

namespace terrane::stream {

namespace {

using world::ChunkPos;

// Null if there is nothing to mesh any more.
ChunkRecord* waitingRecord(ChunkTable& table, ChunkPos pos) {
    ChunkRecord* record = findRecord(table, pos);
    return record && !record->toMesh.isEmpty() ? record : nullptr;
}

}  // namespace

void requestEditedMesh(ChunkTable& table, ChunkPos pos, mesh::MeshSectionSet meshSections) {
    ChunkRecord* record = findRecord(table, pos);
    if (!record || record->stage != ChunkStage::Visible) return;
    const bool isInJob = std::exchange(record->meshJob, 0) != 0;
    record->toMesh |= isInJob ? mesh::kAllMeshSections : meshSections;
    // Edits of one chunk in a row are one request.
    if (table.editedMeshes.empty() || table.editedMeshes.back() != pos) table.editedMeshes.push_back(pos);
}

void requestWholeMesh(ChunkTable& table, ChunkPos pos) {
    ChunkRecord* record = findRecord(table, pos);
    if (!record || record->stage != ChunkStage::Visible) return;
    record->meshJob = 0;
    record->toMesh = mesh::kAllMeshSections;
    table.otherMeshes.push_back(pos);
}

std::vector<MeshRequest> popEditedMeshes(ChunkTable& table, std::size_t limit) {
    std::vector<MeshRequest> popped;
    for (; popped.size() < limit && !table.editedMeshes.empty(); table.editedMeshes.pop_front()) {
        const ChunkPos pos = table.editedMeshes.front();
        if (ChunkRecord* record = waitingRecord(table, pos)) {
            popped.push_back({pos, std::exchange(record->toMesh, {})});
        }
    }
    return popped;
}

std::vector<MeshJob> popMeshJobs(ChunkTable& table, std::size_t limit) {
    std::vector<MeshJob> popped;
    for (; popped.size() < limit && !table.otherMeshes.empty(); table.otherMeshes.pop_front()) {
        const ChunkPos pos = table.otherMeshes.front();
        ChunkRecord* record = waitingRecord(table, pos);
        // A chunk that an edit touched in part is among the edited ones.
        if (!record || record->toMesh != mesh::kAllMeshSections) continue;
        record->toMesh = {};
        record->meshJob = ++table.lastMeshJob;
        popped.push_back({pos, record->meshJob});
    }
    table.meshJobCount += popped.size();
    return popped;
}

bool finishMeshJob(ChunkTable& table, const MeshJob& job) {
    assert(table.meshJobCount > 0 && "what is finished was popped");
    --table.meshJobCount;
    ChunkRecord* record = findRecord(table, job.pos);
    if (!record || record->meshJob != job.number) return false;
    record->meshJob = 0;
    return true;
}

SideSet openSides(const TileView& view, ChunkPos pos) {
    constexpr std::array<std::pair<int, int>, 4> kSides = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    if (view.horizon <= view.viewDistance || !isWithinView(view, parentOf(pos))) return 0;
    SideSet sides = 0;
    for (std::size_t side = 0; side < kSides.size(); ++side) {
        const ChunkPos beside = world::offsetBy(pos, kSides[side].first, kSides[side].second);
        if (world::isInWorld(beside) && !isWithinView(view, parentOf(beside)))
            sides |= static_cast<SideSet>(1u << side);
    }
    return sides;
}

world::ChunkPtr borderChunk(const world::BlockRegistry& blocks, world::Heights heights) {
    const auto types = blocks.types();
    const auto found = std::ranges::find(types, world::Shape::Liquid, &world::BlockType::shape);
    auto chunk = std::make_shared<world::Chunk>(heights);
    if (found == types.end()) return chunk;
    for (int number = heights.firstSection(); number < heights.endSection(); ++number)
        chunk->setSection(number, world::Section(found->id));
    return chunk;
}

void remeshBorders(ChunkTable& table, const TileView& before, const TileView& now) {
    if (before == now) return;
    for (auto& [pos, record] : table.records) {
        if (openSides(before, pos) == openSides(now, pos)) continue;
        record.isOutdated = true;  // running jobs have the old sides
        requestWholeMesh(table, pos);
    }
}

}  // namespace terrane::stream
