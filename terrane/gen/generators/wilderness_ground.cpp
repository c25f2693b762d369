#include <cstdint>
#include <initializer_list>
#include <utility>

#include "terrane/gen/generators/wilderness.h"

// Blocks of wilderness: soil, strata, ore, water, caves and what lives in them; plants.

namespace terrane::gen::wilderness {

namespace {

// Layers of a period of 64 that bands of another rock take: bit k stands for layer k.
using Bands = std::uint64_t;
constexpr Bands bandsOf(std::initializer_list<std::pair<int, int>> firstAndLast) {
    Bands bands = 0;
    for (const auto& [first, last] : firstAndLast)
        for (int k = first; k <= last; ++k) bands |= Bands{1} << k;
    return bands;
}
constexpr Bands kTerracotta =
    bandsOf({{0, 3}, {13, 13}, {17, 20}, {30, 30}, {34, 37}, {47, 47}, {51, 53}, {59, 59}});
constexpr Bands kPaleLines = bandsOf({{9, 9}, {26, 26}, {43, 43}, {56, 56}});
constexpr Bands kCobble = bandsOf({{0, 5}, {30, 30}, {32, 32}});
constexpr Bands kSandstone = bandsOf({{0, 2}, {40, 40}});

Int half(Bands bands, int shift) {
    return Int(static_cast<std::int32_t>(static_cast<std::uint32_t>(bands >> shift)));
}

// Bands of rock, a little bent, in every cliff, mine and cave alike. What kind of bands a column has does not
// depend on z: a layer only looks up a bit.
Block strata(Pass& p, const Fields& f) {
    const Block rock = p.read(f.rock);
    const Bool isRed = rock == p.block("red_sandstone"), isChalk = rock == p.block("limestone");
    const Int bend = Int(bendOfStrata(p) + 16.0f);
    const Int at = (p.z() + bend) & 63;
    const Bool isUpper = at >= 32;
    const auto isIn = [&](Int lower, Int upper) { return (select(isUpper, upper, lower) >> at & 1) == 1; };
    const auto halfOf = [&](int shift) {
        return multiSelect({{isRed, half(kTerracotta, shift)}, {isChalk, half(kSandstone, shift)}},
                           half(kCobble, shift));
    };
    const Block other =
        multiSelect({{isRed, p.block("terracotta")}, {isChalk, p.block("sandstone")}}, p.block("cobble"));
    Var<Block> block = p.var(rock);
    p.if_(isRed || isChalk || rock == p.block("stone"),
          [&] { block = select(isIn(halfOf(0), halfOf(32)), other, rock); });
    p.if_(isRed, [&] {
        const Bool isLine = isIn(half(kPaleLines, 0), half(kPaleLines, 32));
        block = select(isLine, p.block("sandstone"), static_cast<Block>(block));
    });
    return block;
}

// Soil and rock. One list of choices for all depths: branches would need the strata on both sides.
Block solid(Pass& p, const Fields& f) {
    constexpr int kSoilDepth = 3;
    const Int depth = p.read(f.surface) - p.z();
    const Block rock = p.read(f.rock);
    const Block kind =
        multiSelect({{depth == 0, p.read(f.top)}, {depth <= kSoilDepth, p.read(f.soil)}}, rock);
    Var<Block> banded = p.var(strata(p, f));
    if (p.step() == 1) p.if_(depth > kSoilDepth, [&] { banded = withOre(p, f, banded); });
    return select(kind == rock, static_cast<Block>(banded), kind);
}

Block earth(Pass& p, const Fields& f) {
    const Int z = p.z();
    Var<Block> block = p.var(p.read(f.rock));
    if (p.step() == 1) {
        block = withCaves(p, f, solid(p, f));
    } else {
        // Plain rock where no side shows it: tiles span many layers, and those of one block cost nothing.
        p.if_(z >= p.read(f.hidden), [&] { block = solid(p, f); });
    }
    if (p.step() <= kMaxNotchStep) {
        p.if_(z > p.read(f.notchLow) && z < p.read(f.notchHigh),
              [&] { block = select(z <= kSeaZ, p.block("water"), p.block("air")); });
    }
    return block;
}

}  // namespace

Float bendOfStrata(Pass& p) {
    return p.perlin2D("strata", 64, {1.5f, 3.0f, 6.0f});
}

Block landBlock(Pass& p, const Fields& f) {
    const Int z = p.z(), water = p.read(f.water);
    Var<Block> block = p.var(p.block("air"));
    p.if_(
        z <= p.read(f.surface), [&] { block = earth(p, f); },
        [&] {
            const Int fall = p.read(f.fall);
            const Bool isWhite = z > water - fall && z < water + fall - kFoamMark,
                       isFrozen = p.read(f.cold) < -0.7f;
            const Block liquid = multiSelect({{p.read(f.isLava), p.block("lava")},
                                              {isFrozen && (z == water || isWhite), p.block("ice")},
                                              {isWhite, p.block("white_water")}},
                                             p.block("water"));
            Var<Block> open = p.var(select(z <= water, liquid, p.block("air")));
            if (p.step() <= kMaxArchStep) {
                p.if_(z >= p.read(f.archLow) && z <= p.read(f.archHigh), [&] { open = strata(p, f); });
            }
            block = vegetation::aboveGround(p, f.plants, p.read(f.surface), open);
        });
    return block;
}

}  // namespace terrane::gen::wilderness
