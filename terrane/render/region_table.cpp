#include "terrane/render/region_table.h"

#include <algorithm>
#include <span>

#include "terrane/base/profile.h"
#include "terrane/mesh/region_quads.h"
#include "terrane/render/camera.h"

namespace terrane::render {
namespace {

constexpr std::uint32_t kFirstSlots = 1024;  // × 208 bytes

static_assert(shared::kFaceContexts == mesh::kContextCount && shared::kFaceGroups == mesh::kGroupCount);
constexpr std::uint32_t kBlendedRanges =
    shared::firstRange(mesh::faceContext(mesh::AlphaClass::Blended, false));

shared::RegionRecord recordOf(world::ChunkPos pos, const mesh::RegionMesh& region) {
    shared::RegionRecord record{};
    record.chunk = {pos.x, pos.y};
    record.level = pos.level;
    record.heights = static_cast<std::uint32_t>(region.minZ | region.maxZ << 16);
    std::ranges::transform(mesh::rangesOf(region), record.ranges,
                           [](mesh::QuadRange quads) { return glm::uvec2(quads.first, quads.count); });
    return record;
}

world::ChunkPos posOf(const shared::RegionRecord& record) {
    return {record.chunk.x, record.chunk.y, static_cast<std::uint8_t>(record.level)};
}

bool isEmpty(const shared::RegionRecord& record) {
    return std::ranges::all_of(record.ranges, [](glm::uvec2 range) { return range.y == 0; });
}

bool hasBlendedQuads(const shared::RegionRecord& record) {
    return std::ranges::any_of(std::span(record.ranges).subspan(kBlendedRanges),
                               [](glm::uvec2 range) { return range.y > 0; });
}

}  // namespace

RegionTable::RegionTable()
    : records_(kFirstSlots * sizeof(shared::RegionRecord), GL_DYNAMIC_STORAGE_BIT, "regions"),
      orderBuffer_(kFirstSlots * sizeof(std::uint32_t), GL_DYNAMIC_STORAGE_BIT, "order of regions") {}

std::uint32_t RegionTable::allocateSlot() {
    if (!free_.empty()) {
        const std::uint32_t slot = free_.back();
        free_.pop_back();
        return slot;
    }
    cpuRecords_.emplace_back();
    return slots() - 1;
}

// Neighbouring groups share a command: of seven groups at most four commands, or as many as there are groups.
void RegionTable::addCommands(const shared::RegionRecord& record, std::int32_t sign) {
    for (std::uint32_t context = 0; context < shared::kFaceContexts; ++context) {
        const std::uint32_t ranges = context % 2 == 0 ? shared::kFaceGroups : 1;
        std::uint32_t groups = 0, quads = 0;
        for (std::uint32_t k = 0; k < ranges; ++k) {
            const std::uint32_t count = record.ranges[shared::firstRange(context) + k].y;
            groups += count > 0;
            quads += count;
        }
        const std::uint32_t most = std::min(groups, 4u) + quads / shared::kMaxQuadsPerCommand;
        mostCommands_[context] += static_cast<std::uint32_t>(sign) * most;
    }
}

void RegionTable::set(world::ChunkPos pos, std::span<const mesh::RegionMesh> regions,
                      mesh::RegionSet changed) {
    if (chunks_[pos].size() != regions.size()) {
        remove(pos);
        changed = mesh::kAllRegions;
    }
    std::vector<std::uint32_t>& slotsOfChunk = chunks_[pos];
    slotsOfChunk.resize(regions.size(), kNoSlot);
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if (mesh::hasRegion(changed, r)) setRegion(slotsOfChunk[r], recordOf(pos, regions[r]));
    }
    if (regions.empty()) chunks_.erase(pos);
}

// Where the region keeps its slot the order stays: regions of a chunk lie one above the other whatever their
// quads are.
void RegionTable::setRegion(std::uint32_t& slot, const shared::RegionRecord& record) {
    if (slot != kNoSlot) {
        addCommands(cpuRecords_[slot], -1);
        if (hasBlendedQuads(cpuRecords_[slot])) std::erase(blended_, slot);
    }
    const bool hadSlot = slot != kNoSlot, needsSlot = !isEmpty(record);
    if (hadSlot && !needsSlot) {
        order_.remove(slot);
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
    cpuRecords_[slot] = record;
    changed_.push_back(slot);
    if (hasBlendedQuads(record)) blended_.push_back(slot);
    addCommands(record, 1);
}

void RegionTable::remove(world::ChunkPos pos) {
    const auto found = chunks_.find(pos);
    if (found == chunks_.end()) return;
    for (std::uint32_t& slot : found->second) setRegion(slot, {});
    chunks_.erase(found);
}

void RegionTable::uploadRecords() {
    constexpr std::size_t kBytes = sizeof(shared::RegionRecord);
    if (cpuRecords_.size() * kBytes > records_.sizeBytes()) {
        records_ = gpu::Buffer(2 * cpuRecords_.size() * kBytes, GL_DYNAMIC_STORAGE_BIT, "regions");
        records_.uploadVector(0, cpuRecords_);
    } else {
        for (const std::uint32_t slot : changed_) {
            records_.upload(slot * kBytes, std::as_bytes(std::span(&cpuRecords_[slot], 1)));
        }
    }
    changed_.clear();
}

void RegionTable::uploadOrder() {
    const std::vector<std::uint32_t>& slots = order_.slots();
    const std::size_t bytes = slots.size() * sizeof(std::uint32_t);
    if (bytes > orderBuffer_.sizeBytes()) {
        orderBuffer_ = gpu::Buffer(2 * bytes, GL_DYNAMIC_STORAGE_BIT, "order of regions");
    }
    if (!slots.empty()) orderBuffer_.uploadVector(0, slots);
}

void RegionTable::update(world::ChunkPos centre) {
    TERRANE_ZONE("region table");
    if (!changed_.empty()) uploadRecords();
    if (order_.update(centre)) uploadOrder();
}

bool RegionTable::hasBlended(world::ChunkPos centre, std::span<const glm::vec4> planes) const {
    return std::ranges::any_of(blended_, [&](std::uint32_t slot) {
        const shared::RegionRecord& r = cpuRecords_[slot];
        const glm::vec2 corner = shared::chunkCorner(r.chunk, r.level, {centre.x, centre.y});
        const glm::vec3 min(corner, r.heights & 0xFFFF);
        const glm::vec3 max(corner + world::kChunkSize * shared::columnBlocks(r.level), r.heights >> 16);
        return mayBeVisible(planes, min - shared::kWaving, max + shared::kWaving);  // as in cull.comp.glsl
    });
}

}  // namespace terrane::render
