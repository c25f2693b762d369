// Smallest and largest values of a tile or a layer, with SIMD instructions. slab_ranges.cpp uses it.
#pragma once

#include <cstdint>

#include "terrane/gen/compile/value_range.h"

namespace terrane::gen {

// Returns the range of a value's kTileLanes lanes in the arena (program.h), 64-byte aligned.
ValueRange rangeOfTile(Type type, const Bits* values);

struct BlockRange {
    std::uint16_t low, high;
    bool operator==(const BlockRange&) const = default;
};

// Writes the lower halves of kTileLanes values, 64-byte aligned, as a layer's blocks. Returns their range.
BlockRange packLayer(const Bits* values, std::uint16_t* blocks);

}  // namespace terrane::gen
