#include "terrane/mesh/section_bits.h"

#include <algorithm>
#include <bitset>
#include <cassert>
#include <utility>

namespace terrane::mesh {
namespace {

using Word = std::uint64_t;
using world::BlockId;

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

// words: 64 groups of 2^kLog2; afterwards word p of a group is plane p of its 64 blocks. Each step runs over
// all words: such loops are done two words an instruction.
template <int kLog2>
void sortIntoPlanes(Word* words) {
    constexpr std::size_t kWords = std::size_t{64} << kLog2;
    for (int digit = 0; digit < kLog2; ++digit) {
        const std::size_t apart = std::size_t{1} << digit;
        const Word mask = clearDigit(digit);
        for (std::size_t first = 0; first < kWords; first += 2 * apart) {
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
        for (std::size_t a = 0; a < kWords; ++a) {
            const Word t = (words[a] ^ (words[a] >> shift)) & mask;
            words[a] ^= t ^ (t << shift);
        }
    }
}

void sortIntoPlanes(Word* words, std::size_t bits) {
    switch (bits) {
        case 2:
            return sortIntoPlanes<1>(words);
        case 4:
            return sortIntoPlanes<2>(words);
        case 8:
            return sortIntoPlanes<3>(words);
        case 16:
            return sortIntoPlanes<4>(words);
        default:
            assert(bits <= 1 && "a section holds 0, 1, 2, 4, 8 or 16 bits a block");
    }
}

std::vector<BlockId> distinctIds(const world::Section& section) {
    if (section.isUniform()) return {section.uniformValue()};
    if (!section.isDense()) return {section.palette().begin(), section.palette().end()};
    std::bitset<65536> seen;
    std::vector<BlockId> ids;
    for (const Word word : section.words()) {
        for (int shift = 0; shift < 64; shift += 16) {
            const auto id = static_cast<BlockId>(word >> shift);
            if (!seen[id]) ids.push_back(id);
            seen[id] = true;
        }
    }
    return ids;
}

}  // namespace

SectionBits::SectionBits(const world::Section& section)
    : bits_(static_cast<std::size_t>(section.bits())), ids_(distinctIds(section)) {
    const std::span<const Word> words = section.words();
    assert(words.size() == 64 * bits_ && "4,096 blocks of bits() each");
    std::copy(words.begin(), words.end(), planes_.begin());
    sortIntoPlanes(planes_.data(), bits_);
}

BitCube SectionBits::blocks(std::size_t number) const {
    assert(number < ids_.size() && "number of an id");
    const std::size_t index = bits_ == kMaxBits ? ids_[number] : number;
    BitCube out;
    for (std::size_t i = 0; i < out.size(); ++i) {
        Word match = ~Word{0};
        for (std::size_t p = 0; p < bits_; ++p) {
            const Word plane = planes_[i * bits_ + p];
            match &= (index >> p) & 1 ? plane : ~plane;
        }
        out[i] = match;
    }
    return out;
}

}  // namespace terrane::mesh
