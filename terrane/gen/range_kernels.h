// Smallest and largest values of a tile or a layer, with SIMD instructions. Used by slab_ranges.cpp.
#pragma once

#include <cstdint>

#include "terrane/gen/value_range.h"

namespace terrane::gen {

// Of a value's kTileLanes lanes in the arena (program.h), 64-byte aligned.
ValueRange rangeOfTile(Type type, const Bits* values);

struct BlockRange {
    std::uint16_t low, high;
    bool operator==(const BlockRange&) const = default;
};

// Of the kTileLanes blocks of a layer.
BlockRange rangeOfLayer(const std::uint16_t* blocks);

}  // namespace terrane::gen
