// Ground of the overworld: earth, sand, snow and stone, water, caves, ore.
#include "terrane/gen/generators/overworld.h"

namespace terrane::gen::overworld {
namespace {

// Shape of the ground around a column.
struct Shape {
    Float steepness;  // blocks up a block aside
    Float lowest;     // height of the column itself or of the lowest one beside it
};

Shape shape(Pass& p, const Fields& f) {
    const auto at = [&](int dx, int dy) { return p.readAt(f.height, {dx, dy}); };
    const Float beside = min(min(at(1, 0), at(-1, 0)), min(at(0, 1), at(0, -1)));
    Vec2 slope = p.slope(f.height);
    if (p.step() > 1) slope = slope + p.grain2D("slope") * p.read(f.lostSlope);
    return {length(slope), min(beside, p.read(f.height))};
}

struct Ground {
    Block top, soil;
};

Ground groundBlocks(Pass& p, const Fields& f, const Shape& s, Float snowLine, Float patches) {
    const Float height = p.read(f.height), ocean = p.read(f.ocean);
    const Float alpine = smoothstep(-45.0f, 0.0f, height - snowLine);
    const Float stoneFrom = patches * 0.35f + 1.02f - alpine * 0.3f;
    const Bool isSand = p.read(f.desert) > patches * 0.2f + 0.4f;
    const Float beachWidth = p.perlin2D("beach width", 64, {.4f, 1.0f}) * 0.03f + 0.03f;
    const Bool isBeach = height < kSea + 2.2f + patches && ocean > patches * 0.02f - beachWidth;

    Var<Block> top = p.var(p.block("grass"));
    Var<Block> soil = p.var(p.block("dirt"));
    p.if_(height < kSea + patches * 0.8f && ocean < 0.0f,
          [&] { top = select(patches > -0.2f, p.block("sand"), p.block("dirt")); });
    p.if_(isSand || isBeach || ocean > 0.0f, [&] {
        top = p.block("sand");
        soil = p.block("sand");
    });
    p.if_(height < kSea - 9.0f + patches * 4.0f && patches > 0.15f, [&] { top = p.block("dirt"); });
    // The sides of blocks on a slope show the soil: stone there looks like bare rock.
    p.if_(s.steepness > stoneFrom - 0.25f && !isSand, [&] { soil = p.block("stone"); });
    p.if_(s.steepness > stoneFrom, [&] {
        top = p.block("stone");
        soil = p.block("stone");
    });
    p.if_(height > snowLine && s.steepness < patches * 0.9f + 1.45f, [&] { top = p.block("snow"); });
    return {top, soil};
}

// z below which caves may be. The roof has holes, the mouths, in small spots where its thickness is negative.
Int caveTop(Pass& p, const Fields& f, const Shape& s) {
    const Float mouths = smoothstep(0.48f, 0.75f, p.perlin2D("cave mouths", 24, {.2f, 1.0f}));
    const Bool isDry = p.read(f.height) > kSea + 4.0f && s.lowest > kSea + 3.0f;
    const Float roof = select(isDry, Float(6.0f) - mouths * 13.0f, Float(9.0f));
    return Int(floor(s.lowest - roof));
}

Bool isCave(Pass& p, const Fields& f) {
    Var<Bool> result = p.var(Bool(false));
    p.if_(p.z() > p.heights().bottom + 1 && p.z() < p.read(f.caveTop), [&] {
        const Float area = p.perlin3D("cave areas", 32, {1.0f});
        p.if_(area > 0.0f, [&] {
            result = p.perlin3D("caves", 8, {.35f, .6f, .8f, 1.0f}) > 0.42f - min(area, 0.2f);
        });
    });
    return result;
}

}  // namespace

void surfacePass(Pass& p, const Fields& f) {
    const Float height = p.read(f.height), ocean = p.read(f.ocean);
    const Shape s = shape(p, f);
    const Float patches = p.perlin2DWithGrain("ground patches", 8, {.3f, .3f, .6f});
    const Float snowLine = 160.0f + p.read(f.temperature) * 40.0f + patches * 10.0f;
    const Ground ground = groundBlocks(p, f, s, snowLine, patches);

    const Float forest = p.perlin2DWithGrain("forestness", 64, {.06f, .12f, .25f, .5f});
    const Float clearings = smoothstep(0.4f, 0.5f, p.perlin2DWithGrain("clearings", 32, {.3f, 1.0f}));
    const Float treeLine = smoothstep(0.0f, 25.0f, snowLine - 8.0f - height);
    const Float gentle = smoothstep(1.0f, 0.75f, s.steepness);
    const Float density = smoothstep(0.03f, 0.08f, forest - p.read(f.desert)) * (1.0f - clearings * 0.95f);
    p.set(f.surface, Int(floor(height)));
    p.set(f.top, ground.top);
    p.set(f.soil, ground.soil);
    if (p.step() == 1) p.set(f.caveTop, caveTop(p, f, s));
    p.set(f.forest, max(density * 0.9f, 0.012f) * treeLine * gentle * smoothstep(0.0f, -0.05f, ocean));
}

void groundPass(Pass& p, const Fields& f) {
    const Int z = p.z(), surface = p.read(f.surface);
    const Int depth = surface - z;
    Var<Block> block = p.var(p.block("air"));
    p.if_(
        z <= surface,
        [&] {
            p.if_(
                depth <= kSoilDepth, [&] { block = select(depth == 0, p.read(f.top), p.read(f.soil)); },
                [&] {
                    const Float ore = p.perlin3D("ore", 4, {1.0f, .5f});
                    block = select(ore > 0.82f, p.block("glowing_ore"), p.block("stone"));
                });
            block = select(isCave(p, f), p.block("air"), static_cast<Block>(block));
        },
        [&] { block = select(z <= kSeaLevel, p.block("water"), p.block("air")); });
    p.setBlock(block);
}

}  // namespace terrane::gen::overworld
