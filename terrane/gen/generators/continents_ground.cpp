// Ground of continents: soil, strata, ore, water, caves and their lakes.
#include "terrane/gen/generators/continents.h"

namespace terrane::gen::continents {
namespace {

constexpr int kCaveWater = 13;  // z below which caves are lakes

// Bands of rock, a little bent. Only canyon lands show theirs.
Block strata(Pass& p, const Fields& f) {
    const Int bend = Int(p.perlin2D("strata", 64, {1.5f, 3.0f}) + 8.0f);
    const Int band = floorModulo(p.z() + bend, 17);
    const Block stripes = multiSelect({{band < 4, p.block("terracotta")},
                                       {band == 9, p.block("sandstone")},
                                       {band == 13, p.block("terracotta")}},
                                      p.block("red_sandstone"));
    return select(p.read(f.rock) == p.block("red_sandstone"), stripes, p.read(f.rock));
}

// Winding tunnels where two noises are both near 0, and halls, which columns hold up.
Bool isCave(Pass& p, const Fields& f) {
    Var<Bool> result = p.var(Bool(false));
    const Float where = p.perlin2D("cave places", 128, {.5f, 1.0f});
    p.if_(p.z() > 2 && p.z() < p.read(f.caveTop), [&] {
        p.if_(where > -0.05f, [&] {
            const Float a = p.perlin3D("tunnels", 22, {.45f, 1.0f}),
                        b = p.perlin3D("more tunnels", 22, {.45f, 1.0f});
            result = a * a + b * b * 1.6f < min(where + 0.05f, Float(0.25f)) * 0.10f + 0.006f;
        });
        p.if_(where < -0.12f, [&] {
            const Float hall =
                p.perlin3D("halls", 30, {.3f, 1.0f}) - smoothstep(0.0f, 60.0f, Float(p.z()) - 30.0f) * 0.25f;
            const Float column = p.perlin2D("columns", 5, {1.0f, .5f});
            result = hall > 0.30f && column < 0.5f;
        });
    });
    return result;
}

Block veins(Pass& p, Block rock) {
    Var<Block> block = p.var(rock);
    const Float where = p.perlin2D("ore places", 64, {.6f, 1.0f});
    p.if_(where > 0.1f && p.z() < 72, [&] {
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
            const Block top = select(p.read(f.top) == p.block("red_sandstone"), strata(p, f), p.read(f.top));
            const Block soil =
                select(p.read(f.soil) == p.block("red_sandstone"), strata(p, f), p.read(f.soil));
            block = select(depth == 0, top, soil);
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
            const Bool isIce = z == water && p.read(f.cold) < -0.78f;
            const Block liquid = select(isIce, p.block("ice"), p.block("water"));
            block = select(z <= water, liquid, p.block("air"));
        });
    return block;
}

}  // namespace terrane::gen::continents
