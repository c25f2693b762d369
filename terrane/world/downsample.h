// Makes one column, twice as wide, of 2×2 columns of blocks. stream/edited_tiles.cpp makes tiles of the next
// level from edited chunks with it. All functions are pure; any thread may call them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::world {

using BlockColumn = std::vector<BlockId>;  // from the bottom up

// A column of a level, counted in columns of that level: sixteen a chunk.
struct ColumnPos {
    std::int32_t x = 0, y = 0;
    std::uint8_t level = 0;
};

// Properties of a block type for the rule.
struct DownsampleKind {
    enum class Fill : std::uint8_t {
        Open,   // air, plants: invisible from afar
        Solid,  // fills its cell or most of it: cubes of any alpha, cactus
        Liquid,
    };
    Fill fill = Fill::Open;
    bool isOpaque = false;   // hides what lies behind
    std::uint16_t glow = 0;  // 0: no light that is visible from afar; the greater the stronger
};

struct DownsampleRule {
    std::vector<DownsampleKind> kinds;  // by block id; the last one is for unknown blocks too

    const DownsampleKind& kind(BlockId id) const { return kinds[id < kinds.size() ? id : kinds.size() - 1]; }
};

// Weaker light counts as none; otherwise glimmering ore would cover a whole quarry by the rule below.
constexpr int kMinFarEmission = 8;

DownsampleRule downsampleRule(const BlockRegistry& blocks);

// Returns the number of the four blocks that must be solid for the parent to be: 1…4, each for a quarter of
// all columns. So the mean cover of many columns stays the same at every level. It does not depend on z: a
// tower stays whole or is removed.
int coverThreshold(ColumnPos parent);

// Computes the column of `parent` from the four below it, in the order (0, 0), (1, 0), (0, 1), (1, 1), all of
// one height. The
// first rule that holds decides each slice:
//   1. One of the four glows: the one with the strongest light. Light is seen from farther than its lamp.
//   2. At least coverThreshold() are solid: one of these. First those with nothing opaque above, then
//      those beside a block of the four that is not opaque, then the others.
//   3. At least half of those that are not solid are liquid: one of these. Surfaces stay whole and level.
//   4. Air.
// Among equal candidates the most frequent id is taken, then one by the hash of the position. 2 µs on slopes
// of some layers; random blocks take 20.
void downsampleColumn(const DownsampleRule& rule, std::span<const BlockColumn, 4> children, ColumnPos parent,
                      BlockColumn& out);

}  // namespace terrane::world
