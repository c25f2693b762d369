#include "terrane/world/changes/structure.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_model.h"

namespace terrane::world {

namespace {

using SideMap = std::array<Face, 4>;  // by side: the side that it becomes

constexpr SideMap kTurnedSides{kFaceNegY, kFacePosY, kFacePosX, kFaceNegX};
constexpr SideMap kMirroredInX{kFacePosX, kFaceNegX, kFaceNegY, kFacePosY};
constexpr SideMap kMirroredInY{kFaceNegX, kFacePosX, kFacePosY, kFaceNegY};

std::uint16_t mappedArms(std::uint16_t state, const SideMap& sides) {
    std::uint16_t arms = 0;
    for (unsigned side = 0; side < sides.size(); ++side)
        if ((state >> (kStateArmShift + side) & 1) != 0)
            arms |= static_cast<std::uint16_t>(1u << (kStateArmShift + sides[side]));
    return static_cast<std::uint16_t>((state & ~kStateArms) | arms);
}

std::uint16_t withFacing(std::uint16_t state, int facing) {
    return static_cast<std::uint16_t>((state & ~kStateFacing) | (facing & kStateFacing));
}

bool hasFacing(const BlockType& type) {
    return type.model && (type.model->stateMask & kStateFacing) != 0;
}

}  // namespace

std::uint16_t armBits(const BlockType& type) {
    return type.model ? type.model->stateMask & kStateArms : std::uint16_t{0};
}

std::uint16_t turnedState(const BlockType& type, std::uint16_t state, int turns) {
    const int quarters = turns & 3;
    if (hasFacing(type)) state = withFacing(state, (state & kStateFacing) + quarters);
    for (int turn = 0; turn < quarters && armBits(type) != 0; ++turn) state = mappedArms(state, kTurnedSides);
    return state;
}

// Facing counts quarter turns from +y: a mirror turns them the other way, and in y it swaps +y and -y as
// well.
std::uint16_t mirroredState(const BlockType& type, std::uint16_t state, MirrorAxis axis) {
    const bool isX = axis == MirrorAxis::X;
    if (hasFacing(type)) state = withFacing(state, (isX ? 0 : 2) - (state & kStateFacing));
    return armBits(type) != 0 ? mappedArms(state, isX ? kMirroredInX : kMirroredInY) : state;
}

namespace {

bool isSameData(const StructureData& a, const StructureData& b) {
    return a.cell == b.cell && *a.data == *b.data;
}

// Gives each pair of block and state its index in the palette.
class PaletteBuilder {
  public:
    PaletteBuilder(const BlockRegistry& blocks, std::vector<StructureBlock>& palette)
        : blocks_(blocks), palette_(palette) {}

    std::uint32_t index(const BlockValue& value) {
        const auto key = static_cast<std::uint32_t>(value.id << 16 | value.state);
        const auto [found, isNew] = indices_.try_emplace(key, static_cast<std::uint32_t>(palette_.size()));
        if (isNew) palette_.push_back({blocks_.type(value.id).name, value.state});
        return found->second;
    }

  private:
    const BlockRegistry& blocks_;
    std::vector<StructureBlock>& palette_;
    std::unordered_map<std::uint32_t, std::uint32_t> indices_;
};

// Moves blocks to other cells: `place` gives the new cell, `state` the new state of a block.
template <class Place, class State>
Structure moved(const Structure& from, glm::ivec3 size, Place place, State state) {
    Structure to{.size = size, .palette = from.palette, .cells = {}, .data = {}};
    for (StructureBlock& block : to.palette) block.state = state(block);
    to.cells.resize(from.cells.size());
    std::vector<std::uint32_t> newCell(from.data.empty() ? 0 : from.cells.size());
    std::size_t cell = 0;
    for (int z = 0; z < from.size.z; ++z)
        for (int y = 0; y < from.size.y; ++y)
            for (int x = 0; x < from.size.x; ++x, ++cell) {
                const std::uint32_t target = to.cellAt(place(glm::ivec3(x, y, z)));
                to.cells[target] = from.cells[cell];
                if (!newCell.empty()) newCell[cell] = target;
            }
    for (const StructureData& data : from.data) to.data.push_back({newCell[data.cell], data.data});
    std::ranges::sort(to.data, {}, &StructureData::cell);
    return to;
}

// The palette in the order of the cells, as copyBlocks() makes it: equal blocks give equal structures.
Structure withOrderedPalette(Structure structure) {
    std::vector<StructureBlock> palette;
    std::vector<std::uint32_t> indices(structure.palette.size(), UINT32_MAX);
    for (std::uint32_t& cell : structure.cells) {
        std::uint32_t& index = indices[cell];
        if (index == UINT32_MAX) {
            index = static_cast<std::uint32_t>(palette.size());
            palette.push_back(structure.palette[cell]);
        }
        cell = index;
    }
    structure.palette = std::move(palette);
    return structure;
}

Structure turnedOnce(const Structure& from, const BlockRegistry& blocks) {
    const auto place = [&](glm::ivec3 at) { return glm::ivec3(from.size.y - 1 - at.y, at.x, at.z); };
    const auto state = [&](const StructureBlock& block) {
        const BlockType* type = blocks.find(block.name);
        return type ? turnedState(*type, block.state, 1) : block.state;
    };
    return moved(from, {from.size.y, from.size.x, from.size.z}, place, state);
}

}  // namespace

bool operator==(const Structure& a, const Structure& b) {
    return a.size == b.size && a.palette == b.palette && a.cells == b.cells &&
           std::ranges::equal(a.data, b.data, isSameData);
}

Structure copyBlocks(const World& world, const BlockRegistry& blocks, const BlockBox& box) {
    const std::int64_t count = box.blockCount();
    base::require(count > 0 && count <= kMaxStructureBlocks, "copyBlocks: the box has no blocks or too many");
    Structure structure;
    structure.size = {box.high.x - box.low.x + 1, box.high.y - box.low.y + 1, box.high.z - box.low.z + 1};
    structure.cells.reserve(static_cast<std::size_t>(count));
    PaletteBuilder palette(blocks, structure.palette);
    for (std::int64_t cell = 0; cell < count; ++cell) {
        BlockValue value = blockValue(world, box.blockAt(cell));
        structure.cells.push_back(palette.index(value));
        if (value.data) structure.data.push_back({static_cast<std::uint32_t>(cell), std::move(value.data)});
    }
    return structure;
}

Structure turnedStructure(const Structure& structure, const BlockRegistry& blocks, int turns) {
    Structure turned = structure;
    for (int turn = 0; turn < (turns & 3); ++turn) turned = turnedOnce(turned, blocks);
    return withOrderedPalette(std::move(turned));
}

Structure mirroredStructure(const Structure& structure, const BlockRegistry& blocks, MirrorAxis axis) {
    const auto place = [&](glm::ivec3 at) {
        if (axis == MirrorAxis::X) return glm::ivec3(structure.size.x - 1 - at.x, at.y, at.z);
        return glm::ivec3(at.x, structure.size.y - 1 - at.y, at.z);
    };
    const auto state = [&](const StructureBlock& block) {
        const BlockType* type = blocks.find(block.name);
        return type ? mirroredState(*type, block.state, axis) : block.state;
    };
    return withOrderedPalette(moved(structure, structure.size, place, state));
}

std::vector<BlockValue> paletteValues(const Structure& structure, const BlockRegistry& blocks) {
    std::vector<BlockValue> values;
    values.reserve(structure.palette.size());
    for (const StructureBlock& block : structure.palette) {
        const BlockType* type = blocks.find(block.name);
        values.push_back({type ? type->id : blocks.missing(), block.state, nullptr});
    }
    return values;
}

std::vector<std::string> unknownNames(const Structure& structure, const BlockRegistry& blocks) {
    std::vector<std::string> names;
    for (const StructureBlock& block : structure.palette)
        if (!blocks.find(block.name)) names.push_back(block.name);
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

}  // namespace terrane::world
