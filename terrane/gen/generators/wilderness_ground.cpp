#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/generators/wilderness.h"

// Ground of wilderness: soil, strata, ore, water, caves and what lives in them.

namespace terrane::gen::wilderness {

namespace {

constexpr int kCaveWater = -180;  // up to this height caves are lakes

// Bands of rock, a little bent, in every cliff, mine and cave alike.
Block strata(Pass& p, const Fields& f) {
    const Block rock = p.read(f.rock);
    const Int bend = Int(p.perlin2D("strata", 64, {1.5f, 3.0f, 6.0f}) + 16.0f);
    const Int z = p.z() + bend;
    const Int band = floorModulo(z, 17), wide = floorModulo(z, 61);
    const Block red = multiSelect({{band < 4, p.block("terracotta")},
                                   {band == 9, p.block("sandstone")},
                                   {band == 13, p.block("terracotta")}},
                                  rock);
    const Block grey = select(wide < 6 || wide == 30 || wide == 32, p.block("cobble"), rock);
    const Block chalk = select(wide < 3 || wide == 40, p.block("sandstone"), rock);
    return multiSelect({{rock == p.block("red_sandstone"), red},
                        {rock == p.block("stone"), grey},
                        {rock == p.block("limestone"), chalk}},
                       rock);
}

// Winding tunnels where two noises are both near 0, and great halls.
Bool isCave(Pass& p, const Fields& f) {
    Var<Bool> result = p.var(Bool(false));
    const Float where = p.perlin2D("cave places", 128, {.5f, 1.0f});
    p.if_(p.z() > p.heights().bottom + 2 && p.z() < p.read(f.caveTop), [&] {
        p.if_(where > -0.05f, [&] { result = landforms::isTunnel(p, where); });
        p.if_(where < -0.15f, [&] {
            const Float hall = p.perlin3D("halls", 48, {.25f, 1.0f});
            const Float column = p.perlin2D("columns", 5, {1.0f, .5f});
            result = hall > 0.34f && column < 0.55f;
        });
    });
    return result;
}

Block earth(Pass& p, const Fields& f) {
    constexpr int kSoilDepth = 3;
    const Int z = p.z(), depth = p.read(f.surface) - z;
    Var<Block> block = p.var(p.block("air"));
    p.if_(
        depth <= kSoilDepth,
        [&] {
            const Block rock = p.read(f.rock);
            const auto ofRock = [&](Block b) { return select(b == rock, strata(p, f), b); };
            block = select(depth == 0, ofRock(p.read(f.top)), ofRock(p.read(f.soil)));
        },
        [&] { block = p.step() == 1 ? landforms::withOre(p, strata(p, f), 300) : strata(p, f); });
    if (p.step() > 1) return block;
    const Block inside = select(z <= kCaveWater, p.block("water"), p.block("air"));
    return select(isCave(p, f), inside, static_cast<Block>(block));
}

}  // namespace

Block ground(Pass& p, const Fields& f) {
    const Int z = p.z(), water = p.read(f.water);
    Var<Block> block = p.var(p.block("air"));
    p.if_(
        z <= p.read(f.surface), [&] { block = earth(p, f); },
        [&] {
            const Bool isIce = z == water && p.read(f.cold) < -0.7f;
            const Block liquid = select(isIce, p.block("ice"), p.block("water"));
            block = select(z <= water, liquid, p.block("air"));
        });
    return block;
}

void caveLifePass(Pass& p, const Fields& f) {
    landforms::growCaveLife(p, p.read(f.caveTop), {-40, 0.012f, 0.018f, 0.03f});
}

}  // namespace terrane::gen::wilderness
