#include "terrane/stream/meshing.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <utility>

#include "terrane/mesh/section_faces.h"

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

namespace {

// Closes the caves at one side. `closed` is a copy of the chunk, made when there is something to close.
class SideCloser {
  public:
    SideCloser(const world::Chunk& chunk, std::size_t side, const world::BlockRegistry& blocks)
        : chunk_(chunk), side_(side), blocks_(blocks) {}

    void run(std::shared_ptr<world::Chunk>& closed) const {
        constexpr int kRoof = 8;  // blocks: hollows above are seen from outside
        const int top = lowestGround() - kRoof;
        std::array<world::BlockId, world::kChunkSize> roofs{};
        const int lowest = std::max(chunk_.lowestMade(), chunk_.heights().firstSection());
        for (int number = top >> 4; number >= lowest; --number) {
            const bool isClosed = mesh::isAllOpaque(chunk_.section(number), blocks_);
            const int bottom = number * world::kSectionSize;
            for (int z = isClosed ? bottom : std::min(top, bottom + 15); z >= bottom; --z) {
                for (int k = 0; k < world::kChunkSize; ++k) {
                    world::BlockId& roof = roofs[static_cast<std::size_t>(k)];
                    const world::BlockIndex index = indexOf(k, z);
                    if (isOpaque(chunk_.block(index))) {
                        roof = chunk_.block(index);
                    } else if (roof != world::kAir) {
                        if (!closed) closed = std::make_shared<world::Chunk>(chunk_);
                        closed->setBlock(index, roof);
                    }
                }
            }
        }
    }

  private:
    // Of column k of 16 at the side.
    world::BlockIndex indexOf(int k, int z) const {
        const int border = side_ % 2 == 0 ? 0 : world::kChunkSize - 1;
        return side_ < 2 ? world::blockIndex(border, k, z) : world::blockIndex(k, border, z);
    }
    bool isOpaque(world::BlockId id) const { return id != world::kAir && blocks_.type(id).opaqueCube; }

    int lowestGround() const {
        int ground = chunk_.heights().top;
        for (int k = 0; k < world::kChunkSize; ++k) {
            int z = ground - 1;
            while (z >= chunk_.heights().bottom && !isOpaque(chunk_.block(indexOf(k, z))))
                z -= chunk_.section(z >> 4).isUniform() ? (z & 15) + 1 : 1;
            ground = z + 1;
        }
        return ground;
    }

    const world::Chunk& chunk_;
    std::size_t side_;
    const world::BlockRegistry& blocks_;
};

}  // namespace

world::ChunkPtr closeCaves(const world::ChunkPtr& chunk, SideSet sides, const world::BlockRegistry& blocks) {
    std::shared_ptr<world::Chunk> closed;
    for (std::size_t side = 0; side < 4; ++side)
        if ((sides >> side & 1) != 0) SideCloser(*chunk, side, blocks).run(closed);
    return closed ? world::ChunkPtr(std::move(closed)) : chunk;
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
