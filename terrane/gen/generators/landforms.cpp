#include "terrane/gen/generators/landforms.h"

#include "terrane/gen/language/compounds.h"

namespace terrane::gen::landforms {

Float terraces(Float height, float rise, float steepness) {
    const Float steps = height * (1.0f / rise);
    const Float whole = floor(steps), part = steps - whole;
    return (whole + smoothstep(0.5f - 0.5f / steepness, 0.5f + 0.5f / steepness, part)) * rise;
}

Float tables(Pass& p) {
    const Float tables = p.simplex2D("tables", 32, {.04f, .10f, .25f, .6f, 1.0f});
    const Float canyons = abs(p.simplex2D("canyons", 64, {.06f, .15f, .45f, 1.0f}));
    const Float high = smoothstep(-0.35f, 0.75f, tables) * 78.0f;
    return terraces(high, 15.0f, 4.5f) * smoothstep(0.02f, 0.2f, canyons) + 4.0f;
}

Float dunes(Pass& p) {
    constexpr int kSize = 80;
    const float left = shareLeft(kSize, p.step());
    const Float bend = p.simplex2D("wind", 256, {.5f, 1.0f}) * 0.35f;
    const Stripes2D wave = p.stripes2D("dunes", kSize, {1.0f - bend * bend * 0.5f, bend});
    const Float crest = wave.cosine * 0.5f + 0.5f;
    const Float lee = max(wave.sine, Float(0.0f)) * crest * 0.5f;
    const Float large = smoothstep(-0.3f, 0.6f, p.simplex2D("dune sizes", 256, {.5f, 1.0f}));
    return lerp(Float(0.4f), crest * crest - lee + 0.1f, left) * (large * 15.0f + 3.0f);
}

Float towers(Pass& p) {
    constexpr int kSize = 72;
    const float left = shareLeft(kSize, p.step());
    const Voronoi2D cell = p.voronoi2D("towers", kSize, 1);
    const Float radius = p.simplex2D("tower sizes", 128, {.5f, 1.0f}) * 9.0f + 23.0f;
    const Float near = clamp(1.0f - cell.distance / radius, 0.0f, 1.0f);
    const Float tower = smoothstep(0.0f, 0.35f, near) * 0.7f + near * 0.3f;
    return lerp(Float(0.2f), tower, left) * (radius * 2.1f);
}

Float fromOrigin(Pass& p, int radius) {
    const auto near = [&](Int v) {
        return Float(clamp(v, -radius, radius)) * (1.0f / static_cast<float>(radius));
    };
    const Float x = near(p.x()), y = near(p.y());
    return x * x + y * y;
}

Block riverBed(Pass& p, Float patches, Float spots) {
    return multiSelect({{patches > 0.25f, p.block("clay")}, {spots > 0.1f, p.block("gravel")}},
                       p.block("sand"));
}

Bool isTunnel(Pass& p, Float where) {
    const Float a = p.perlin3D("tunnels", 22, {.45f, 1.0f}), b = p.perlin3D("more tunnels", 22, {.45f, 1.0f});
    return a * a + b * b * 1.6f < min(where + 0.05f, Float(0.25f)) * 0.10f + 0.006f;
}

Block withOre(Pass& p, Block rock, Bool isDeep) {
    Var<Block> block = p.var(rock);
    const Float where = p.perlin2D("ore places", 64, {.6f, 1.0f});
    p.if_(where > 0.1f && isDeep, [&] {
        const Float ore = p.perlin3D("ore", 4, {1.0f, .5f});
        block = select(ore > 0.78f, p.block("glowing_ore"), static_cast<Block>(block));
    });
    return block;
}

void growCaveLife(Pass& p, Int caveTop, const CaveLife& life) {
    Var<Block> block = p.var(p.blockHere());
    p.if_(p.z() < caveTop && p.blockHere() == p.block("air"), [&] {
        const Block below = p.blockInColumn(p.z() - 1);
        const Bool isFloor = below != p.block("air") && below != p.block("water");
        const Float chance = p.random3D("cave life", p.x(), p.y(), p.z());
        const Block grown =
            multiSelect({{chance < life.crystals && p.z() < life.crystalsBelow, p.block("crystal")},
                         {chance < life.glowingMushrooms, p.block("glowing_mushroom")},
                         {chance < life.mushrooms, p.block("brown_mushroom")}},
                        p.block("air"));
        block = select(isFloor, grown, static_cast<Block>(block));
    });
    p.setBlock(block);
}

}  // namespace terrane::gen::landforms
