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

// Winding tunnels where two noises are both near 0, great halls, and shafts between them.
Bool isCave(Pass& p, const Fields& f) {
    Var<Bool> result = p.var(Bool(false));
    const Float where = p.perlin2D("cave places", 128, {.5f, 1.0f});
    p.if_(p.z() > p.heights().bottom + 2 && p.z() < p.read(f.caveTop), [&] {
        p.if_(where > -0.05f, [&] {
            const Float a = p.perlin3D("tunnels", 22, {.45f, 1.0f}),
                        b = p.perlin3D("more tunnels", 22, {.45f, 1.0f});
            result = a * a + b * b * 1.6f < min(where + 0.05f, Float(0.25f)) * 0.10f + 0.006f;
        });
        p.if_(where < -0.15f, [&] {
            const Float hall = p.perlin3D("halls", 48, {.25f, 1.0f});
            const Float column = p.perlin2D("columns", 5, {1.0f, .5f});
            result = hall > 0.34f && column < 0.55f;
        });
    });
    return result;
}

Block veins(Pass& p, Block rock) {
    Var<Block> block = p.var(rock);
    const Float where = p.perlin2D("ore places", 64, {.6f, 1.0f});
    p.if_(where > 0.1f && p.z() < 300, [&] {
        const Float ore = p.perlin3D("ore", 4, {1.0f, .5f});
        block = select(ore > 0.78f, p.block("glowing_ore"), static_cast<Block>(block));
    });
    return block;
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
        [&] { block = p.step() == 1 ? veins(p, strata(p, f)) : strata(p, f); });
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
    Var<Block> block = p.var(p.blockHere());
    p.if_(p.z() < p.read(f.caveTop) && p.blockHere() == p.block("air"), [&] {
        const Block below = p.blockInColumn(p.z() - 1);
        const Bool isFloor = below != p.block("air") && below != p.block("water");
        const Float chance = p.random3D("cave life", p.x(), p.y(), p.z());
        const Block grown = multiSelect({{chance < 0.012f && p.z() < -40, p.block("crystal")},
                                         {chance < 0.018f, p.block("glowing_mushroom")},
                                         {chance < 0.03f, p.block("brown_mushroom")}},
                                        p.block("air"));
        block = select(isFloor, grown, static_cast<Block>(block));
    });
    p.setBlock(block);
}

}  // namespace terrane::gen::wilderness
