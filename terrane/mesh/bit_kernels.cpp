#include "terrane/mesh/bit_kernels.h"

#include <array>
#include <cassert>
#include <utility>

// Vectors of 16 bytes need SSSE3, which every x86 with a driver for OpenGL 4.5 has. So Highway's fallback
// without vectors is not compiled.
#if defined(__x86_64__)
#define HWY_BASELINE_TARGETS HWY_SSSE3
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrane/mesh/bit_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TERRANE_MESH_BIT_KERNELS_TABLES
#define TERRANE_MESH_BIT_KERNELS_TABLES
namespace terrane::mesh {

using Word = std::uint64_t;

// A step of sorting bits into planes: swaps the bits whose number in the word has bit `high` clear and bit
// `low` set with those that have `high` set and `low` clear.
struct Exchange {
    int shift;
    Word mask;  // the first kind
};

constexpr Exchange exchange(int low, int high) {
    Word mask = 0;
    for (int i = 0; i < 64; ++i) {
        if (((i >> low) & 1) == 1 && ((i >> high) & 1) == 0) mask |= Word{1} << i;
    }
    return {(1 << high) - (1 << low), mask};
}

// 2^log2 words hold 64 blocks. Read in binary, a bit's number in its word is, from the lowest digit, log2
// digits of the plane and then the low digits of the block; the word's number is the high digits of the
// block. First the digits of word and plane change places, after which each word is one plane. That leaves
// the 6 digits of the block rotated in the bit's number; the steps of a Rotation put them in order.
struct Rotation {
    std::array<Exchange, 5> steps{};
    std::size_t count = 0;
};

constexpr Rotation rotation(int log2) {
    std::array<int, 6> digits{};
    for (int i = 0; i < 6; ++i) digits[static_cast<std::size_t>(i)] = (i + 6 - log2) % 6;
    Rotation result;
    for (int want = 0; want < 6; ++want) {
        int at = want;
        while (digits[static_cast<std::size_t>(at)] != want) ++at;
        if (at == want) continue;
        std::swap(digits[static_cast<std::size_t>(at)], digits[static_cast<std::size_t>(want)]);
        result.steps[result.count++] = exchange(want, at);
    }
    return result;
}

// Bits of a word whose number has this digit clear.
constexpr Word clearDigit(int digit) {
    Word mask = 0;
    for (int i = 0; i < 64; ++i) mask |= ((i >> digit) & 1) == 0 ? Word{1} << i : 0;
    return mask;
}

}  // namespace terrane::mesh
#endif

HWY_BEFORE_NAMESPACE();
namespace terrane::mesh {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<Word, 4> kWords;  // a layer, or less
const hn::FixedTag<Word, 2> kHalfLayer;
const hn::FixedTag<std::uint16_t, 8> kRows;  // the same
using Words = hn::Vec<decltype(kWords)>;

// Exchanges bits selected by mask << shift in a with those selected by mask in b.
HWY_INLINE void exchangeBits(Words& a, Words& b, int shift, Words mask) {
    const Words t = hn::And(hn::Xor(hn::ShiftRightSame(a, shift), b), mask);
    b = hn::Xor(b, t);
    a = hn::Xor(a, hn::ShiftLeftSame(t, shift));
}

template <int kLog2>
HWY_INLINE void exchangeWords(std::size_t groups, Word* planes) {
    constexpr std::size_t kBits = std::size_t{1} << kLog2;
    for (int digit = 0; digit < kLog2; ++digit) {
        const std::size_t apart = std::size_t{1} << digit;
        const Words mask = hn::Set(kWords, clearDigit(digit));
        for (std::size_t low = 0; low < kBits; ++low) {
            if (low & apart) continue;
            Word *a = planes + low * groups, *b = a + apart * groups;
            for (std::size_t g = 0; g < groups; g += hn::Lanes(kWords)) {
                Words va = hn::LoadU(kWords, a + g), vb = hn::LoadU(kWords, b + g);
                exchangeBits(va, vb, static_cast<int>(apart), mask);
                hn::StoreU(va, kWords, a + g);
                hn::StoreU(vb, kWords, b + g);
            }
        }
    }
}

template <int kLog2>
HWY_INLINE void rotateDigits(std::size_t groups, Word* planes) {
    static constexpr Rotation kRotation = rotation(kLog2);
    for (std::size_t at = 0; at < groups << kLog2; at += hn::Lanes(kWords)) {
        Words v = hn::LoadU(kWords, planes + at);
        for (std::size_t s = 0; s < kRotation.count; ++s) {
            const auto [shift, mask] = kRotation.steps[s];
            const Words t = hn::And(hn::Xor(v, hn::ShiftRightSame(v, shift)), hn::Set(kWords, mask));
            v = hn::Xor(v, hn::Or(t, hn::ShiftLeftSame(t, shift)));
        }
        hn::StoreU(v, kWords, planes + at);
    }
}

template <int kLog2>
void sortGroups(const Word* packed, std::size_t groups, Word* planes) {
    constexpr std::size_t kBits = std::size_t{1} << kLog2;
    for (std::size_t g = 0; g < groups; ++g) {
        for (std::size_t p = 0; p < kBits; ++p) planes[p * groups + g] = packed[g * kBits + p];
    }
    exchangeWords<kLog2>(groups, planes);
    rotateDigits<kLog2>(groups, planes);
}

void sort(const Word* packed, std::size_t bits, std::size_t groups, Word* planes) {
    switch (bits) {
        case 1:
            return sortGroups<0>(packed, groups, planes);
        case 2:
            return sortGroups<1>(packed, groups, planes);
        case 4:
            return sortGroups<2>(packed, groups, planes);
        case 8:
            return sortGroups<3>(packed, groups, planes);
        case 16:
            return sortGroups<4>(packed, groups, planes);
        default:
            return;
    }
}

void match(const BitPlanes& planes, std::size_t index, Word* out) {
    for (std::size_t g = 0; g < planes.groups; g += hn::Lanes(kWords)) {
        Words all = hn::Set(kWords, ~Word{0});
        for (std::size_t p = 0; p < planes.bits; ++p) {
            const Words flip = hn::Set(kWords, (index >> p & 1) != 0 ? Word{0} : ~Word{0});
            all = hn::And(all, hn::Xor(hn::LoadU(kWords, planes.words + p * planes.groups + g), flip));
        }
        hn::StoreU(all, kWords, out + g);
    }
}

void rowsInUse(const BitCube& cube, LayerRange range, std::uint16_t* used) {
    for (std::size_t layer = range.first; layer < range.end; ++layer) {
        std::uint8_t bits[2];
        for (std::size_t half = 0; half < 2; ++half) {
            const auto v = hn::BitCast(kRows, hn::LoadU(kHalfLayer, &cube[4 * layer + 2 * half]));
            hn::StoreMaskBits(kRows, hn::Ne(v, hn::Zero(kRows)), &bits[half]);
        }
        used[layer] = static_cast<std::uint16_t>(bits[0] | bits[1] << 8);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::mesh
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrane::mesh {

HWY_EXPORT(sort);
HWY_EXPORT(match);
HWY_EXPORT(rowsInUse);

void sortIntoPlanes(const std::uint64_t* packed, std::size_t bits, std::size_t groups,
                    std::uint64_t* planes) {
    assert(bits <= 16 && (bits & (bits - 1)) == 0 && "a section holds 0, 1, 2, 4, 8 or 16 bits a block");
    assert(groups % 4 == 0 && "groups are taken four at a time");
    HWY_DYNAMIC_DISPATCH(sort)(packed, bits, groups, planes);
}

void blocksOfIndex(const BitPlanes& planes, std::size_t index, std::uint64_t* out) {
    HWY_DYNAMIC_DISPATCH(match)(planes, index, out);
}

void usedRows(const BitCube& cube, LayerRange range, BitSlice& used) {
    HWY_DYNAMIC_DISPATCH(rowsInUse)(cube, range, used.data());
}

}  // namespace terrane::mesh
#endif
