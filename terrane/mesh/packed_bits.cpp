#include "terrane/mesh/packed_bits.h"

#include <array>
#include <cassert>
#include <utility>

namespace terrane::mesh {
namespace {

using Word = std::uint64_t;

// A step of sorting bits into planes: the bits whose number in the word has bit `high` clear and bit `low`
// set change places with those that have `high` set and `low` clear.
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

// Bits of a word whose number has a digit clear.
constexpr Word clearDigit(int digit) {
    Word mask = 0;
    for (int i = 0; i < 64; ++i) mask |= ((i >> digit) & 1) == 0 ? Word{1} << i : 0;
    return mask;
}

// Each step runs over all words: such loops are done two words an instruction.
template <int kLog2>
void sortGroups(Word* words, std::size_t groups) {
    const std::size_t count = groups << kLog2;
    for (int digit = 0; digit < kLog2; ++digit) {
        const std::size_t apart = std::size_t{1} << digit;
        const Word mask = clearDigit(digit);
        for (std::size_t first = 0; first < count; first += 2 * apart) {
            for (std::size_t a = first; a < first + apart; ++a) {
                const Word t = ((words[a] >> apart) ^ words[a + apart]) & mask;
                words[a + apart] ^= t;
                words[a] ^= t << apart;
            }
        }
    }
    static constexpr Rotation kRotation = rotation(kLog2);
    for (std::size_t s = 0; s < kRotation.count; ++s) {
        const auto [shift, mask] = kRotation.steps[s];
        for (std::size_t a = 0; a < count; ++a) {
            const Word t = (words[a] ^ (words[a] >> shift)) & mask;
            words[a] ^= t ^ (t << shift);
        }
    }
}

}  // namespace

void sortIntoPlanes(Word* words, std::size_t bits, std::size_t groups) {
    switch (bits) {
        case 2:
            return sortGroups<1>(words, groups);
        case 4:
            return sortGroups<2>(words, groups);
        case 8:
            return sortGroups<3>(words, groups);
        case 16:
            return sortGroups<4>(words, groups);
        default:
            assert(bits <= 1 && "a section holds 0, 1, 2, 4, 8 or 16 bits a block");
    }
}

}  // namespace terrane::mesh
