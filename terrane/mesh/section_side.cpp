#include "terrane/mesh/section_side.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <type_traits>

#include "terrane/mesh/bit_kernels.h"

namespace terrane::mesh {
namespace {

using world::BlockId;
using world::Section;

static_assert(std::endian::native == std::endian::little, "packed words are read in memory order");

// Indices of the blocks in a layer: first + row·rowStep + bit·bitStep.
struct LayerIndices {
    std::size_t first, rowStep, bitStep;
};

constexpr std::array<LayerIndices, world::kFaceCount> kLayers{{
    {0, 256, 16},       // -x: x = 0; rows z, bits y
    {15, 256, 16},      // +x
    {0, 256, 1},        // -y: y = 0; rows z, bits x
    {15 * 16, 256, 1},  // +y
    {0, 16, 1},         // -z: z = 0; rows y, bits x
    {15 * 256, 16, 1},  // +z
}};

// Copies rows whose blocks are contiguous in the section: 16 blocks are 2·bits bytes.
template <std::size_t kBits>
void copyRows(const std::byte* section, const LayerIndices& layer, std::byte* out) {
    for (std::size_t row = 0; row < 16; ++row) {
        std::memcpy(out + row * 2 * kBits, section + (layer.first + row * layer.rowStep) * kBits / 8,
                    2 * kBits);
    }
}

// Collects rows of blocks that lie 16 apart: the first or the last of each 16.
template <std::size_t kBits, bool kLast>
void collectRows(const std::byte* section, std::uint64_t* out) {
    using Unit = std::conditional_t<kBits == 16, std::uint16_t, std::uint8_t>;  // has the block's bits
    constexpr unsigned kShift = kLast && kBits < 8 ? 8 - kBits : 0;
    constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
    constexpr std::size_t kPerWord = 64 / kBits;
    const std::byte* at = section + (kLast ? 2 * kBits - sizeof(Unit) : 0);
    for (std::size_t w = 0; w < 256 / kPerWord; ++w) {
        std::uint64_t word = 0;
#pragma GCC unroll 64
        for (std::size_t k = 0; k < kPerWord; ++k, at += 2 * kBits) {
            Unit unit;
            std::memcpy(&unit, at, sizeof(unit));
            word |= (std::uint64_t{unit} >> kShift & kMask) << (k * kBits);
        }
        out[w] = word;
    }
}

template <std::size_t kBits>
void copyLayer(const Section& section, world::Face side, std::uint64_t* out) {
    const auto* bytes = reinterpret_cast<const std::byte*>(section.words().data());
    if (side == world::kFaceNegX) return collectRows<kBits, false>(bytes, out);
    if (side == world::kFacePosX) return collectRows<kBits, true>(bytes, out);
    copyRows<kBits>(bytes, kLayers[side], reinterpret_cast<std::byte*>(out));
}

constexpr BitSlice filledIf(bool filled) {
    return filled ? filledSlice() : BitSlice{};
}

}  // namespace

SectionSide::SectionSide(const Section& section, world::Face side) : section_(section), side_(side) {
    assert(side < world::kFaceCount && "one of six sides");
    std::array<std::uint64_t, kGroups * 16> packed;
    switch (section.bits()) {
        case 0:
            return;
        case 1:
            copyLayer<1>(section, side, packed.data());
            break;
        case 2:
            copyLayer<2>(section, side, packed.data());
            break;
        case 4:
            copyLayer<4>(section, side, packed.data());
            break;
        case 8:
            copyLayer<8>(section, side, packed.data());
            break;
        default:
            copyLayer<16>(section, side, packed.data());
    }
    sortIntoPlanes(packed.data(), static_cast<std::size_t>(section.bits()), kGroups, planes_.data());
}

BitSlice SectionSide::blocksOfIndex(std::size_t index) const {
    std::array<std::uint64_t, kGroups> words;
    mesh::blocksOfIndex({planes_.data(), static_cast<std::size_t>(section_.bits()), kGroups}, index,
                        words.data());
    BitSlice slice;
    std::memcpy(slice.data(), words.data(), sizeof(slice));
    return slice;
}

BitSlice SectionSide::opaqueCubes(const world::BlockRegistry& blocks) const {
    if (section_.isUniform()) return filledIf(blocks.type(section_.uniformValue()).opaqueCube);
    if (section_.isDense()) return denseOpaqueCubes(blocks);
    const std::span<const BlockId> palette = section_.palette();
    BitSlice slice{};
    for (std::size_t index = 0; index < palette.size(); ++index) {
        if (!blocks.type(palette[index]).opaqueCube) continue;
        const BitSlice more = blocksOfIndex(index);
        for (std::size_t row = 0; row < 16; ++row) slice[row] |= more[row];
    }
    return slice;
}

// A dense section may have thousands of ids, so its blocks are tested one by one.
BitSlice SectionSide::denseOpaqueCubes(const world::BlockRegistry& blocks) const {
    const LayerIndices layer = kLayers[side_];
    BitSlice slice{};
    for (std::size_t row = 0; row < 16; ++row) {
        unsigned set = 0;
        for (std::size_t bit = 0; bit < 16; ++bit) {
            const auto index = static_cast<int>(layer.first + row * layer.rowStep + bit * layer.bitStep);
            set |= unsigned{blocks.type(section_.get(index)).opaqueCube} << bit;
        }
        slice[row] = static_cast<std::uint16_t>(set);
    }
    return slice;
}

BitSlice SectionSide::blocks(BlockId id) const {
    if (section_.isUniform()) return filledIf(section_.uniformValue() == id);
    if (section_.isDense()) return blocksOfIndex(id);
    const std::span<const BlockId> palette = section_.palette();
    const auto found = std::find(palette.begin(), palette.end(), id);
    if (found == palette.end()) return {};
    return blocksOfIndex(static_cast<std::size_t>(found - palette.begin()));
}

bool isAllOpaque(const Section& section, const world::BlockRegistry& blocks) {
    const auto opaque = [&](BlockId id) { return blocks.type(id).opaqueCube; };
    if (section.isUniform()) return opaque(section.uniformValue());
    return !section.isDense() && std::all_of(section.palette().begin(), section.palette().end(), opaque);
}

}  // namespace terrane::mesh
