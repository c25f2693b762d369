#include "terrane/mesh/section_side.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace terrane::mesh {
namespace {

using world::BlockId;
using world::Section;

// Which blocks of a section make the rows of a layer: indices first + row·rowStep + bit·bitStep.
struct LayerIndices {
    unsigned first, rowStep, bitStep;
};

constexpr std::array<LayerIndices, world::kFaceCount> kLayers{{
    {0, 256, 16},       // -x: x = 0; rows z, bits y
    {15, 256, 16},      // +x
    {0, 256, 1},        // -y: y = 0; rows z, bits x
    {15 * 16, 256, 1},  // +y
    {0, 16, 1},         // -z: z = 0; rows y, bits x
    {15 * 256, 16, 1},  // +z
}};

// The blocks of a layer for which match(packed index or id) is not 0, which is then 1.
template <class Match>
BitSlice matchLayer(const Section& section, world::Face side, Match match) {
    const LayerIndices layer = kLayers[side];
    const std::uint64_t* words = section.words().data();
    const auto bits = static_cast<unsigned>(section.bits());
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    BitSlice slice;
    for (unsigned row = 0; row < 16; ++row) {
        unsigned at = (layer.first + row * layer.rowStep) * bits;
        unsigned set = 0;
        for (unsigned bit = 0; bit < 16; ++bit, at += layer.bitStep * bits) {
            set |= static_cast<unsigned>(match((words[at / 64] >> at % 64) & mask)) << bit;
        }
        slice[row] = static_cast<std::uint16_t>(set);
    }
    return slice;
}

constexpr BitSlice filledIf(bool filled) {
    return filled ? filledSlice() : BitSlice{};
}

}  // namespace

BitSlice opaqueOnSide(const Section& section, world::Face side, const world::BlockRegistry& blocks) {
    assert(side < world::kFaceCount && "one of six sides");
    if (section.isUniform()) return filledIf(blocks.type(section.uniformValue()).opaqueCube);
    if (section.isDense()) {
        return matchLayer(section, side,
                          [&](std::uint64_t id) { return blocks.type(static_cast<BlockId>(id)).opaqueCube; });
    }
    std::array<std::uint8_t, 256> opaque;  // of each palette index
    std::size_t opaqueCount = 0;
    const std::span<const BlockId> palette = section.palette();
    for (std::size_t i = 0; i < palette.size(); ++i) {
        opaque[i] = blocks.type(palette[i]).opaqueCube ? 1 : 0;
        opaqueCount += opaque[i];
    }
    if (opaqueCount == 0 || opaqueCount == palette.size()) return filledIf(opaqueCount != 0);
    return matchLayer(section, side, [&](std::uint64_t index) { return opaque[index]; });
}

BitSlice blocksOnSide(const Section& section, world::Face side, BlockId id) {
    assert(side < world::kFaceCount && "one of six sides");
    if (section.isUniform()) return filledIf(section.uniformValue() == id);
    std::uint64_t wanted = id;
    if (!section.isDense()) {
        const std::span<const BlockId> palette = section.palette();
        const auto found = std::find(palette.begin(), palette.end(), id);
        if (found == palette.end()) return {};
        wanted = static_cast<std::uint64_t>(found - palette.begin());
    }
    return matchLayer(section, side, [wanted](std::uint64_t index) { return index == wanted; });
}

bool isAllOpaque(const Section& section, const world::BlockRegistry& blocks) {
    const auto opaque = [&](BlockId id) { return blocks.type(id).opaqueCube; };
    if (section.isUniform()) return opaque(section.uniformValue());
    return !section.isDense() && std::all_of(section.palette().begin(), section.palette().end(), opaque);
}

}  // namespace terrane::mesh
