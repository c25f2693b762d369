#include "terrane/mesh_gpu/mesh_upload_internal.h"

#include <algorithm>

#include "terrane/base/result.h"
#include "terrane/mesh/section_faces.h"

namespace terrane::mesh_gpu {
namespace {

using shared::uint;
using world::Section;

const Section& sectionOf(const world::Chunk& chunk, int number) {
    static const Section kAir;
    const world::Heights heights = chunk.heights();
    return number >= heights.firstSection() && number < heights.endSection() ? chunk.section(number) : kAir;
}

const Section& statesOf(const world::Chunk& chunk, int number) {
    static const Section kNone;
    const world::Heights heights = chunk.heights();
    return number >= heights.firstSection() && number < heights.endSection() ? chunk.blockStates(number)
                                                                             : kNone;
}

// The section beyond a side; null above and below the world.
const Section* beside(const mesh::MeshInput& chunk, int number, uint side) {
    if (side < 4) return &sectionOf(*chunk.neighbors[side], number);
    const int other = side == world::kFaceNegZ ? number - 1 : number + 1;
    const world::Heights heights = chunk.center->heights();
    const bool isInside = other >= heights.firstSection() && other < heights.endSection();
    return isInside ? &chunk.center->section(other) : nullptr;
}

bool isZero(const Section& section) {
    return section.isUniform() && section.uniformValue() == 0;
}

}  // namespace

void MeshUpload::clear() {
    units_.clear();
    packed_.clear();
    slots_.clear();
    meshSections_.clear();
    chunkEnds_.clear();
}

uint MeshUpload::slotOf(const Section& section, bool holdsBlocks) {
    const auto [found, isNew] = slots_.try_emplace(&section, static_cast<uint>(packed_.sections.size()));
    if (!isNew) return found->second;
    const auto entryOf = [&](std::uint16_t value) {
        return holdsBlocks ? value | types_.type(value).flags << 16 : uint{value};
    };
    return world::appendSection(packed_, section, entryOf);
}

// Whether faces of a section may be visible. False for air only, and for opaque cubes surrounded by opaque
// cubes: 4 or 5 sections of a landscape chunk are left.
bool MeshUpload::mayBeSeen(const mesh::MeshInput& chunk, int number) const {
    const Section& section = chunk.center->section(number);
    const auto isInvisible = [&](std::uint16_t id) {
        return (types_.type(id).flags & shared::kMeshShapeMask) == 0;
    };
    if (section.isUniform() && isInvisible(section.uniformValue())) return false;
    if (!section.isUniform() && !section.isDense() && std::ranges::all_of(section.palette(), isInvisible)) {
        return false;
    }
    if (!mesh::isAllOpaque(section, *chunk.blocks)) return true;
    for (uint side = 0; side < world::kFaceCount; ++side) {
        const Section* next = beside(chunk, number, side);
        if (!next && side == world::kFaceNegZ) continue;
        if (!next || !mesh::isAllOpaque(*next, *chunk.blocks)) return true;
    }
    return false;
}

// Adds one unit, or two if a mesh section is half as high as a section.
void MeshUpload::addUnits(const mesh::MeshInput& chunk, int number) {
    shared::MeshUnit unit{};
    unit.section = slotOf(chunk.center->section(number), true);
    const auto stateSlot = [&](const Section& states) {
        return isZero(states) ? shared::kNoSection : slotOf(states, false);
    };
    unit.blockState = stateSlot(chunk.center->blockStates(number));
    for (uint side = 0; side < 4; ++side)
        unit.neighborStates[side] = stateSlot(statesOf(*chunk.neighbors[side], number));
    for (uint side = 0; side < world::kFaceCount; ++side) {
        const Section* next = beside(chunk, number, side);
        const uint none = side == world::kFaceNegZ ? shared::kOpaqueSection : shared::kNoSection;
        unit.neighbors[side] = next ? slotOf(*next, true) : none;
    }
    const int baseZ = number * world::kSectionSize, height = chunk.options.meshSectionHeight;
    unit.baseZ = shared::quadZOf(baseZ);
    const int step = std::min(height, world::kSectionSize);
    for (int layer = 0; layer < world::kSectionSize; layer += step) {
        unit.meshSection = meshSectionOf(baseZ + layer, height);
        unit.layers = static_cast<uint>(layer | (layer + step) << 16);
        units_.push_back(unit);
    }
}

// The number of the chunk's mesh section with a layer, which is the last one or comes after it.
uint MeshUpload::meshSectionOf(int z, int height) {
    const std::size_t firstOfChunk = chunkEnds_.empty() ? 0 : chunkEnds_.back();
    if (meshSections_.size() == firstOfChunk || meshSections_.back().top <= z) {
        mesh::MeshSection& added = meshSections_.emplace_back();
        added.bottom = z & ~(height - 1);
        added.top = added.bottom + height;
    }
    return static_cast<uint>(meshSections_.size() - 1);
}

void MeshUpload::add(const mesh::MeshInput& chunk) {
    base::require(chunk.center && std::ranges::count(chunk.neighbors, nullptr) == 0,
                  "GpuMesher: a chunk is meshed when its neighbors are known");
    const world::Heights heights = chunk.center->heights();
    for (int number = heights.firstSection(); number < heights.endSection(); ++number) {
        if (mayBeSeen(chunk, number)) addUnits(chunk, number);
    }
    chunkEnds_.push_back(meshSections_.size());
}

}  // namespace terrane::mesh_gpu
