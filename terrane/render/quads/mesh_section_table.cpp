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
    record.place = shared::packPlace(pos.level, shared::quadSlab(meshSection.bottom));
    record.heights = shared::packHeights(meshSection.minZ, meshSection.maxZ);
    std::ranges::transform(mesh::rangesOf(meshSection), record.ranges,
                           [](mesh::QuadRange quads) { return glm::uvec2(quads.first, quads.count); });
    return record;
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
                           const mesh::MeshSectionSet& changed) {
    const std::vector<Slot> before = std::move(chunks_[pos]);
    std::vector<Slot>& slots = chunks_[pos];
    slots.clear();
    auto old = before.begin();
    const auto freeBelow = [&](int bottom) {
        for (; old != before.end() && old->bottom < bottom; ++old) free(old->number);
    };
    for (const mesh::MeshSection& meshSection : meshSections) {
        freeBelow(meshSection.bottom);
        // If the mesh section keeps its slot, the order stays: it depends on the place only, not on the
        // quads.
        const bool isKept = old != before.end() && old->bottom == meshSection.bottom;
        const std::uint32_t slot = isKept ? (old++)->number : allocateSlot();
        slots.push_back({meshSection.bottom, slot});
        if (isKept && !changed.has(meshSection)) continue;
        const shared::MeshSectionRecord record = recordOf(pos, meshSection);
        if (isKept) {
            clear(slot);
        } else {
            order_.add(slot, pos, static_cast<std::int32_t>(record.heights));
            ++count_;
        }
        fill(slot, record);
    }
    freeBelow(world::kHighestTop);
    if (slots.empty()) chunks_.erase(pos);
}

// The slot is clear.
void MeshSectionTable::fill(std::uint32_t slot, const shared::MeshSectionRecord& record) {
    changes_.push_back(casterBoxOf(record));
    cpuRecords_[slot] = record;
    changed_.push_back(slot);
    if (hasBlendedQuads(record)) blended_.push_back(slot);
    addCommands(record, 1);
}

void MeshSectionTable::clear(std::uint32_t slot) {
    changes_.push_back(casterBoxOf(cpuRecords_[slot]));
    addCommands(cpuRecords_[slot], -1);
    if (hasBlendedQuads(cpuRecords_[slot])) std::erase(blended_, slot);
    cpuRecords_[slot] = {};
}

void MeshSectionTable::free(std::uint32_t slot) {
    clear(slot);
    order_.remove(slot);
    free_.push_back(slot);
    --count_;
}

void MeshSectionTable::remove(world::ChunkPos pos) {
    const auto found = chunks_.find(pos);
    if (found == chunks_.end()) return;
    for (const Slot& slot : found->second) free(slot.number);
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
        const shared::uint level = shared::placeLevel(r.place);
        const glm::vec2 corner = shared::chunkCorner(r.chunk, level, {center.x, center.y});
        const glm::vec3 min =
            glm::vec3(corner, shared::lowHeight(r.heights)) - shared::kWaving;  // as in cull.comp.glsl
        const glm::vec3 max = glm::vec3(corner + world::kChunkSize * shared::columnBlocks(level),
                                        shared::highHeight(r.heights)) +
                              shared::kWaving;
        if (mayBeVisible(planes, min, max)) covered.cover(screenRectOf(min, max, viewProjection, size));
        if (covered.isFull()) break;
    }
    return covered.rects();
}

}  // namespace terrane::render
