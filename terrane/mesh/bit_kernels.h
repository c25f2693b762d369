// Kernels on many words of bits, in SIMD through Highway, for the best instruction set of the machine. The
// mesher's stages use it; pure functions, any thread.
#pragma once

#include <cstddef>
#include <cstdint>

#include "terrane/mesh/bit_cube.h"

namespace terrane::mesh {

// Packed block indices as bit planes: word p·groups + g holds bit p of the indices of the 64 successive
// blocks of group g, so that a few ANDs find the blocks of one index.
struct BitPlanes {
    const std::uint64_t* words;
    std::size_t bits, groups;  // groups is a multiple of 4
};

// Sorts packed indices into planes. `packed` has groups · bits words as in world::Section, `bits` is 0, 1, 2,
// 4, 8 or 16, and `planes` has as many words.
void sortIntoPlanes(const std::uint64_t* packed, std::size_t bits, std::size_t groups, std::uint64_t* planes);

// Finds the blocks that have an index: one word a group.
void blocksOfIndex(const BitPlanes& planes, std::size_t index, std::uint64_t* out);

// Finds the rows that have bits, for each layer of the range.
void usedRows(const BitCube& cube, LayerRange range, BitSlice& used);

}  // namespace terrane::mesh
