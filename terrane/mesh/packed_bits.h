// Packed block indices as bit planes: plane p holds bit p of 64 successive blocks' indices in one word, so
// that a few ANDs find the blocks of one index. Used by section_bits.cpp and section_side.cpp; pure
// functions, any thread.
#pragma once

#include <cstddef>
#include <cstdint>

namespace terrane::mesh {

// words: groups of `bits` words, each group the packed indices of 64 blocks, as in world::Section (bits is 0,
// 1, 2, 4, 8 or 16). Afterwards word p of a group is plane p of its blocks.
void sortIntoPlanes(std::uint64_t* words, std::size_t bits, std::size_t groups);

// Which of the 64 blocks of one group have this index.
inline std::uint64_t matching(const std::uint64_t* planes, std::size_t bits, std::size_t index) {
    std::uint64_t match = ~std::uint64_t{0};
    for (std::size_t p = 0; p < bits; ++p) match &= (index >> p) & 1 ? planes[p] : ~planes[p];
    return match;
}

}  // namespace terrane::mesh
