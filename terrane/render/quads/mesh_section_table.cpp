#include "terrane/render/quads/mesh_section_table.h"

#include <algorithm>
#include <span>

#include "terrane/base/profile.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/render/frame/camera.h"
#include "terrane/render/quads/quad_store.h"
#include "terrane/render/shadow/shadow_casters.h"

namespace terrane::render {
namespace {

constexpr std::uint32_t kFirstSlots = 1024;  // × 208 bytes

static_assert(shared::kDrawBuckets == mesh::kDrawBucketCount &&
              shared::kFaceDirections == mesh::kFaceDirectionCount);
constexpr std::uint32_t kBlendedRanges =
    shared::firstRange(mesh::drawBucket(mesh::AlphaClass::Blended, false));

shared::MeshSectionRecord recordOf(world::ChunkPos pos, const mesh::MeshSection& meshSection) {
    shared::MeshSectionRecord record{};
    record.chunk = {pos.x, pos.y};
    record.level = pos.level;
    record.heights = static_cast<std::uint32_t>(meshSection.minZ | meshSection.maxZ << 16);
    std::ranges::transform(mesh::rangesOf(meshSection), record.ranges,
                           [](mesh::QuadRange quads) { return glm::uvec2(quads.first, quads.count); });
    return record;
}

world::ChunkPos posOf(const shared::MeshSectionRecord& record) {
    return {record.chunk.x, record.chunk.y, static_cast<std::uint8_t>(record.level)};
}

bool isEmpty(const shared::MeshSectionRecord& record) {
    return std::ranges::all_of(record.ranges, [](glm::uvec2 range) { return range.y == 0; });
}

bool hasBlendedQuads(const shared::MeshSectionRecord& record) {
    return std::ranges::any_of(std::span(record.ranges).subspan(kBlendedRanges),
                               [](glm::uvec2 range) { return range.y > 0; });
}

}  // namespace

MeshSectionTable::MeshSectionTable(std::uint32_t arenaQuads)
    : arenaQuads_(arenaQuads),
      records_(kFirstSlots * sizeof(shared::MeshSectionRecord), GL_DYNAMIC_STORAGE_BIT, "mesh sections"),
      orderBuffer_(kFirstSlots * sizeof(std::uint32_t), GL_DYNAMIC_STORAGE_BIT, "order of mesh sections") {}

std::uint32_t MeshSectionTable::allocateSlot() {
    if (!free_.empty()) {
        const std::uint32_t slot = free_.back();
        free_.pop_back();
        return slot;
    }
    cpuRecords_.emplace_back();
    return slots() - 1;
}

void MeshSectionTable::addCommands(const shared::MeshSectionRecord& record, std::int32_t sign) {
    const std::size_t arena = record.ranges[0].x / arenaQuads_;
    if (arena >= maxCommands_.size()) maxCommands_.resize(arena + 1);
    std::array<mesh::QuadRange, shared::kRangesPerMeshSection> ranges;
    std::ranges::transform(record.ranges, ranges.begin(), [](glm::uvec2 range) {
        return mesh::QuadRange{range.x, range.y};
    });
    const BucketCommands most = mostCommands(ranges);
    for (std::uint32_t bucket = 0; bucket < shared::kDrawBuckets; ++bucket)
        maxCommands_[arena][bucket] += static_cast<std::uint32_t>(sign) * most[bucket];
}

void MeshSectionTable::set(world::ChunkPos pos, std::span<const mesh::MeshSection> meshSections,
                           mesh::MeshSectionSet changed) {
    if (chunks_[pos].size() != meshSections.size()) {
        remove(pos);
        changed = mesh::kAllMeshSections;
    }
    std::vector<std::uint32_t>& slotsOfChunk = chunks_[pos];
    slotsOfChunk.resize(meshSections.size(), kNoSlot);
    for (std::size_t r = 0; r < meshSections.size(); ++r) {
        if (mesh::hasMeshSection(changed, r)) setMeshSection(slotsOfChunk[r], recordOf(pos, meshSections[r]));
    }
    if (meshSections.empty()) chunks_.erase(pos);
}

// If the mesh section keeps its slot, the order stays: it depends on the place only, not on the quads.
void MeshSectionTable::setMeshSection(std::uint32_t& slot, const shared::MeshSectionRecord& record) {
    if (slot != kNoSlot) {
        changes_.push_back(casterBoxOf(cpuRecords_[slot]));
        addCommands(cpuRecords_[slot], -1);
        if (hasBlendedQuads(cpuRecords_[slot])) std::erase(blended_, slot);
    }
    const bool hadSlot = slot != kNoSlot, needsSlot = !isEmpty(record);
    if (hadSlot && !needsSlot) {
        order_.remove(slot);
        cpuRecords_[slot] = {};
        free_.push_back(slot);
        slot = kNoSlot;
        --count_;
    }
    if (!hadSlot && needsSlot) {
        slot = allocateSlot();
        order_.add(slot, posOf(record), record.heights);
        ++count_;
    }
    if (!needsSlot) return;
    changes_.push_back(casterBoxOf(record));
    cpuRecords_[slot] = record;
    changed_.push_back(slot);
    if (hasBlendedQuads(record)) blended_.push_back(slot);
    addCommands(record, 1);
}

void MeshSectionTable::remove(world::ChunkPos pos) {
    const auto found = chunks_.find(pos);
    if (found == chunks_.end()) return;
    for (std::uint32_t& slot : found->second) setMeshSection(slot, {});
    chunks_.erase(found);
}

void MeshSectionTable::uploadRecords() {
    constexpr std::size_t kBytes = sizeof(shared::MeshSectionRecord);
    if (const std::size_t bytes = grownBytes(records_, cpuRecords_.size() * kBytes)) {
        records_ = gpu::Buffer(bytes, GL_DYNAMIC_STORAGE_BIT, "mesh sections");
        records_.uploadVector(0, cpuRecords_);
    } else {
        for (const std::uint32_t slot : changed_) {
            records_.upload(slot * kBytes, std::as_bytes(std::span(&cpuRecords_[slot], 1)));
        }
    }
    changed_.clear();
}

void MeshSectionTable::uploadOrder() {
    const std::vector<std::uint32_t>& slots = order_.slots();
    if (const std::size_t bytes = grownBytes(orderBuffer_, slots.size() * sizeof(std::uint32_t))) {
        orderBuffer_ = gpu::Buffer(bytes, GL_DYNAMIC_STORAGE_BIT, "order of mesh sections");
    }
    if (!slots.empty()) orderBuffer_.uploadVector(0, slots);
}

std::size_t MeshSectionTable::gpuBytes() const {
    return bytesWhileGrowing(records_, cpuRecords_.size() * sizeof(shared::MeshSectionRecord)) +
           bytesWhileGrowing(orderBuffer_, count_ * sizeof(std::uint32_t));
}

void MeshSectionTable::update(world::ChunkPos center) {
    TERRANE_ZONE("mesh section table");
    if (!changed_.empty()) uploadRecords();
    if (order_.update(center)) uploadOrder();
}

std::vector<ScreenRect> MeshSectionTable::blendedRects(world::ChunkPos center,
                                                       const glm::mat4& viewProjection,
                                                       glm::ivec2 size) const {
    const Frustum planes = frustumOf(viewProjection);
    ScreenGrid covered(size);
    for (const std::uint32_t slot : blended_) {
        const shared::MeshSectionRecord& r = cpuRecords_[slot];
        const glm::vec2 corner = shared::chunkCorner(r.chunk, r.level, {center.x, center.y});
        const glm::vec3 min =
            glm::vec3(corner, r.heights & 0xFFFF) - shared::kWaving;  // as in cull.comp.glsl
        const glm::vec3 max =
            glm::vec3(corner + world::kChunkSize * shared::columnBlocks(r.level), r.heights >> 16) +
            shared::kWaving;
        if (mayBeVisible(planes, min, max)) covered.cover(screenRectOf(min, max, viewProjection, size));
        if (covered.isFull()) break;
    }
    return covered.rects();
}

}  // namespace terrane::render
