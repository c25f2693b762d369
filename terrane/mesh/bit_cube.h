// Sets of blocks of a section as bits, so that one machine instruction handles 64 blocks. The mesher's stages
// use it; pure functions, any thread.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "terrane/world/blocks/block_type.h"

namespace terrane::mesh {

// 16³ bits in 16 layers of 16 rows of 16: row r of layer l is bits 16·(r mod 4)…+15 of word 4·l + r/4. Layers
// run along z. Rows along x: row is y, bit is x, as blocks lie in a section. Rows along y: row is x, bit is
// y; used for the sides -x and +x, so that the same code serves x and y.
using BitCube = std::array<std::uint64_t, 64>;

// A layer of 16×16 blocks, as 16 rows. Across x: row is z, bit is y. Across y: row is z, bit is x. Across z:
// row is y, bit is x.
using BitSlice = std::array<std::uint16_t, 16>;

// Layers of a section, the end excluded. Functions that take one read and write only these layers of a cube.
struct LayerRange {
    std::size_t first = 0, end = 16;

    constexpr bool isEmpty() const { return first >= end; }
};

constexpr BitSlice filledSlice() {
    BitSlice slice{};
    for (std::uint16_t& row : slice) row = 0xFFFF;
    return slice;
}

constexpr bool isAlongX(world::Face side) {
    return side == world::kFaceNegX || side == world::kFacePosX;
}
constexpr bool isAlongZ(world::Face side) {
    return side == world::kFaceNegZ || side == world::kFacePosZ;
}

// Returns the layers of `range` from the first to the last that has bits in both.
LayerRange commonLayers(const BitCube& a, const BitCube& b, LayerRange range);

inline BitCube both(const BitCube& a, const BitCube& b, LayerRange range) {
    BitCube out;
    for (std::size_t i = 4 * range.first; i < 4 * range.end; ++i) out[i] = a[i] & b[i];
    return out;
}

inline BitCube without(const BitCube& a, const BitCube& b, LayerRange range) {
    BitCube out;
    for (std::size_t i = 4 * range.first; i < 4 * range.end; ++i) out[i] = a[i] & ~b[i];
    return out;
}

// Returns the blocks in `layers` for which `is` returns true, called with their index in the section.
template <class Is>
BitCube blocksWhere(const BitCube& blocks, LayerRange layers, Is is) {
    BitCube out;
    for (std::size_t i = 4 * layers.first; i < 4 * layers.end; ++i) {
        out[i] = 0;
        for (std::uint64_t left = blocks[i]; left != 0; left &= left - 1) {
            const auto bit = static_cast<std::size_t>(std::countr_zero(left));
            if (is(64 * i + bit)) out[i] |= std::uint64_t{1} << bit;
        }
    }
    return out;
}

// Transposes bits and rows of each layer: from rows along x to rows along y and back.
BitCube transposed(const BitCube& cube, LayerRange range = {});

// Returns for each block the bit of its neighbor on a side. The cube has rows along y for the sides of x,
// else rows along x. `border` is the layer of blocks beyond that side of the section. For sides of z the
// layers next to the range are read too.
BitCube neighborBits(const BitCube& cube, world::Face side, const BitSlice& border, LayerRange range = {});

}  // namespace terrane::mesh
