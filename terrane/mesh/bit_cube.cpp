#include "terrane/mesh/bit_cube.h"

#include <algorithm>
#include <cassert>

namespace terrane::mesh {
namespace {

using Word = std::uint64_t;

// Exchanges the columns of `a` selected by mask << shift with those of `b` selected by mask.
void swapColumns(Word& a, Word& b, int shift, Word mask) {
    const Word t = ((a >> shift) ^ b) & mask;
    b ^= t;
    a ^= t << shift;
}

// Exchanges bits selected by mask with those `shift` above them.
Word swapBits(Word w, int shift, Word mask) {
    const Word t = (w ^ (w >> shift)) & mask;
    return w ^ t ^ (t << shift);
}

// Transposes by halving: blocks of 8×8 bits are swapped across the diagonal, then 4×4, 2×2, 1×1. Rows 8 and 4
// apart are in different words, rows 2 and 1 apart are 32 and 16 bits apart in the same word.
void transposeLayer(const Word* in, Word* out) {
    Word w0 = in[0], w1 = in[1], w2 = in[2], w3 = in[3];
    swapColumns(w0, w2, 8, 0x00FF00FF00FF00FF);
    swapColumns(w1, w3, 8, 0x00FF00FF00FF00FF);
    swapColumns(w0, w1, 4, 0x0F0F0F0F0F0F0F0F);
    swapColumns(w2, w3, 4, 0x0F0F0F0F0F0F0F0F);
    const Word layer[4] = {w0, w1, w2, w3};
    for (int i = 0; i < 4; ++i) {
        out[i] = swapBits(swapBits(layer[i], 32 - 2, 0x00000000CCCCCCCC), 16 - 1, 0x0000AAAA0000AAAA);
    }
}

Word fourRows(const BitSlice& slice, std::size_t first) {
    return Word{slice[first]} | Word{slice[first + 1]} << 16 | Word{slice[first + 2]} << 32 |
           Word{slice[first + 3]} << 48;
}

BitCube neighborLayers(const BitCube& cube, bool positive, const BitSlice& border, LayerRange range) {
    BitCube out;
    for (std::size_t layer = range.first; layer < range.end; ++layer) {
        Word* o = &out[4 * layer];
        if (layer == (positive ? 15 : 0)) {
            for (std::size_t i = 0; i < 4; ++i) o[i] = fourRows(border, 4 * i);
        } else {
            std::copy_n(&cube[4 * (positive ? layer + 1 : layer - 1)], 4, o);
        }
    }
    return out;
}

BitCube neighborRows(const BitCube& cube, bool positive, const BitSlice& border, LayerRange range) {
    BitCube out;
    for (std::size_t layer = range.first; layer < range.end; ++layer) {
        const Word* w = &cube[4 * layer];
        Word* o = &out[4 * layer];
        if (positive) {
            for (int i = 0; i < 3; ++i) o[i] = w[i] >> 16 | w[i + 1] << 48;
            o[3] = w[3] >> 16 | Word{border[layer]} << 48;
        } else {
            o[0] = w[0] << 16 | border[layer];
            for (int i = 1; i < 4; ++i) o[i] = w[i] << 16 | w[i - 1] >> 48;
        }
    }
    return out;
}

bool hasCommon(const BitCube& a, const BitCube& b, std::size_t layer) {
    Word any = 0;
    for (std::size_t i = 4 * layer; i < 4 * layer + 4; ++i) any |= a[i] & b[i];
    return any != 0;
}

}  // namespace

LayerRange commonLayers(const BitCube& a, const BitCube& b, LayerRange range) {
    while (!range.isEmpty() && !hasCommon(a, b, range.first)) ++range.first;
    while (!range.isEmpty() && !hasCommon(a, b, range.end - 1)) --range.end;
    return range;
}

BitCube transposed(const BitCube& cube, LayerRange range) {
    BitCube out;
    for (std::size_t layer = range.first; layer < range.end; ++layer) {
        transposeLayer(&cube[4 * layer], &out[4 * layer]);
    }
    return out;
}

BitCube neighborBits(const BitCube& cube, world::Face side, const BitSlice& border, LayerRange range) {
    assert(side < world::kFaceCount && "one of six sides");
    const bool positive = side % 2 == 1;
    return isAlongZ(side) ? neighborLayers(cube, positive, border, range)
                          : neighborRows(cube, positive, border, range);
}

}  // namespace terrane::mesh
