#include "terrane/mesh/section_side.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "terrane/mesh/packed_bits.h"

namespace terrane::mesh {
namespace {

using world::BlockId;
using world::Section;

static_assert(std::endian::native == std::endian::little, "packed words are read in memory order");

// Which blocks of a section make the rows of a layer: indices first + row·rowStep + bit·bitStep.
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

// Rows whose blocks follow each other in the section: 16 blocks are 2·bits bytes.
template <std::size_t kBits>
void copyRows(const std::byte* section, const LayerIndices& layer, std::byte* out) {
    for (std::size_t row = 0; row < 16; ++row) {
        std::memcpy(out + row * 2 * kBits, section + (layer.first + row * layer.rowStep) * kBits / 8,
                    2 * kBits);
    }
}

// Rows of blocks that lie 16 apart.
template <std::size_t kBits>
void collectRows(const std::byte* section, const LayerIndices& layer, std::uint64_t* out) {
    constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
    constexpr std::size_t kPerWord = 64 / kBits;
    const std::size_t shift = layer.first * kBits % 8;
    for (std::size_t first = 0; first < 256; first += kPerWord) {
        std::uint64_t word = 0;
        for (std::size_t k = 0; k < kPerWord; ++k) {
            const std::size_t block = layer.first + (first + k) * 16;
            std::uint16_t pair = 0;  // the block's bits and perhaps others
            std::memcpy(&pair, section + block * kBits / 8, kBits == 16 ? 2 : 1);
            word |= (std::uint64_t{pair} >> shift & kMask) << (k * kBits);
        }
        *out++ = word;
    }
}

template <std::size_t kBits>
void copyLayer(const Section& section, world::Face side, std::uint64_t* out) {
    const auto* bytes = reinterpret_cast<const std::byte*>(section.words().data());
    if (isAlongX(side)) return collectRows<kBits>(bytes, kLayers[side], out);
    copyRows<kBits>(bytes, kLayers[side], reinterpret_cast<std::byte*>(out));
}

constexpr BitSlice filledIf(bool filled) {
    return filled ? filledSlice() : BitSlice{};
}

}  // namespace

SectionSide::SectionSide(const Section& section, world::Face side) : section_(section), side_(side) {
    assert(side < world::kFaceCount && "one of six sides");
    switch (section.bits()) {
        case 0:
            return;
        case 1:
            copyLayer<1>(section, side, planes_.data());
            break;
        case 2:
            copyLayer<2>(section, side, planes_.data());
            break;
        case 4:
            copyLayer<4>(section, side, planes_.data());
            break;
        case 8:
            copyLayer<8>(section, side, planes_.data());
            break;
        default:
            copyLayer<16>(section, side, planes_.data());
    }
    sortIntoPlanes(planes_.data(), static_cast<std::size_t>(section.bits()), kGroups);
}

BitSlice SectionSide::blocksOfIndex(std::size_t index) const {
    const auto bits = static_cast<std::size_t>(section_.bits());
    BitSlice slice;
    for (std::size_t g = 0; g < kGroups; ++g) {
        const std::uint64_t match = matching(&planes_[g * bits], bits, index);
        std::memcpy(&slice[4 * g], &match, sizeof(match));
    }
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

// Of thousands of ids each would be looked for alone: here the blocks are asked one by one.
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
