#include "terrane/mesh/section_bits.h"

#include <bitset>
#include <cassert>

#include "terrane/mesh/bit_kernels.h"

namespace terrane::mesh {
namespace {

using Word = std::uint64_t;
using world::BlockId;

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
    sortIntoPlanes(words.data(), bits_, kGroups, planes_.data());
}

BitCube SectionBits::blocks(std::size_t number) const {
    assert(number < ids_.size() && "number of an id");
    const std::size_t index = bits_ == kMaxBits ? ids_[number] : number;
    BitCube out;
    blocksOfIndex({planes_.data(), bits_, kGroups}, index, out.data());
    return out;
}

}  // namespace terrane::mesh
