// The generators of the tutorial in docs/worldgen.md, step by step.
#include "examples/tutorial_generators.h"

namespace terrane::examples {

using namespace gen;

// Step 1: flat land.
void writeStep1(GeneratorBuilder& g) {
    g.pass3D("ground", [](Pass& p) { p.setBlock(select(p.z() <= 80, p.block("grass"), p.block("air"))); });
}

// Step 2: hills and lakes. A 2D pass computes the height once per column.
void writeStep2(GeneratorBuilder& g) {
    const auto height = g.field<Int>("height");
    g.pass2D("land", [&](Pass& p) {
        p.set(height, Int(82.0f + p.perlin2D("hills", 32, {2.0f, 5.0f, 12.0f})));
    });
    g.pass3D("ground", [&](Pass& p) {
        const Block open = select(p.z() <= 80, p.block("water"), p.block("air"));
        p.setBlock(select(p.z() <= p.read(height), p.block("grass"), open));
    });
}

namespace {

// Rock on steep ground, from the heights around, and snow on high ground.
void setCover(Pass& p, Field<Int> height, Field<Block> cover) {
    const Int here = p.read(height);
    const Int dx = p.readAt(height, {1, 0}) - p.readAt(height, {-1, 0});
    const Int dy = p.readAt(height, {0, 1}) - p.readAt(height, {0, -1});
    p.set(cover, multiSelect({{here <= 81, p.block("sand")},
                              {abs(dx) + abs(dy) > 4, p.block("stone")},
                              {here > 128, p.block("snow")}},
                             p.block("grass")));
}

Int mountainHeight(Pass& p) {
    const Float hills = p.perlin2D("hills", 32, {2.0f, 5.0f, 12.0f});
    const Float where = smoothstep(0.0f, 0.5f, p.perlin2D("mountains", 256, {1.0f}));
    const Float ridge = p.voronoi2D("ridges", 160, 1).distance * (1.0f / 160.0f);
    return Int(82.0f + hills + where * ridge * 120.0f);
}

// The block without caves.
Block solidBlock(Pass& p, Field<Int> height, Field<Block> cover) {
    const Int depth = p.read(height) - p.z();
    Var<Block> block = p.var(select(p.z() <= 80, p.block("water"), p.block("air")));
    p.if_(depth >= 0, [&] { block = p.block("stone"); });
    p.if_(depth >= 0 && depth < 3, [&] { block = p.read(cover); });
    return block;
}

}  // namespace

// Step 3: mountains with ridges; bare stone where it is steep.
void writeStep3(GeneratorBuilder& g) {
    const auto height = g.field<Int>("height");
    const auto cover = g.field<Block>("cover");
    g.pass2D("land", [&](Pass& p) { p.set(height, mountainHeight(p)); });
    g.pass2D("cover", [&](Pass& p) { setCover(p, height, cover); });
    g.pass3D("ground", [&](Pass& p) { p.setBlock(solidBlock(p, height, cover)); });
}

// Step 4: caves. 3D noise is expensive: it is inside an if_, so that layers of air and water skip it.
void writeStep4(GeneratorBuilder& g) {
    const auto height = g.field<Int>("height");
    const auto cover = g.field<Block>("cover");
    g.pass2D("land", [&](Pass& p) { p.set(height, mountainHeight(p)); });
    g.pass2D("cover", [&](Pass& p) { setCover(p, height, cover); });
    g.pass3D("ground", [&](Pass& p) {
        Var<Block> block = p.var(solidBlock(p, height, cover));
        p.if_(p.z() <= p.read(height) && p.read(height) > 84 && p.z() > 2, [&] {
            const Float rock = p.perlin3D("caves", 12, {.4f, .7f, 1.0f});
            block = select(rock > 0.42f, p.block("air"), static_cast<Block>(block));
        });
        p.setBlock(block);
    });
    // A last pass that reads the blocks left by the caves: mushrooms on their floors, tufts on the grass.
    g.pass3D("plants", [&](Pass& p) {
        const Block below = p.blockInColumn(p.z() - 1);
        p.if_(p.blockHere() == p.block("air") && p.randomBool3D("grows", 0.1f, p.x(), p.y(), p.z()), [&] {
            const Bool isDeep = p.z() < p.read(height) - 4;
            p.setBlock(multiSelect({{below == p.block("grass"), p.block("grass_tuft")},
                                    {isDeep && below == p.block("stone"), p.block("glowing_mushroom")}},
                                   p.block("air")));
        });
    });
}

namespace {

constexpr float kSea = 80.0f;

// The terrain without details, which rivers follow.
Float wideLand(Pass& p) {
    return 100.0f + p.perlin2D("wide land", 128, {5.0f, 10.0f, 20.0f, 30.0f, 40.0f});
}

struct Land {
    Float ground, water;  // z
};

// Near water the ground approaches the height of the banks, from above or below. Lakes come first, so that a
// river keeps its banks where it meets one.
Land landWithRivers(Pass& p, const DrainageSample& s) {
    const Float land = wideLand(p) + p.perlin2D("small hills", 16, {1.0f, 2.0f, 3.0f});
    const Float shore = s.lakeDistance + p.perlin2D("shores", 16, {3.0f, 6.0f});
    const Float bank = s.distance - s.halfWidth;
    Float ground = lerp(s.lakeLevel + 1.0f, land, smoothstep(0.0f, 60.0f, shore));
    ground = lerp(s.level + 1.0f, ground, smoothstep(0.0f, 60.0f, bank));
    ground = select(land < kSea, min(land, ground), ground);  // no banks in the sea
    const Float across = min(s.distance / max(s.halfWidth, 1.0f), 1.0f);
    const Float riverBed = s.level - 1.0f - (1.0f - across * across) * s.halfWidth * 0.3f;
    const Float lakeBed = s.lakeLevel - 1.0f + max(shore, -40.0f) * 0.2f;
    return {multiSelect({{shore < 0.0f, lakeBed}, {bank < 0.0f, min(ground, riverBed)}}, ground),
            multiSelect({{shore < 0.0f, s.lakeLevel}, {bank < 0.0f, s.level}}, Float(kSea))};
}

}  // namespace

void writeRivers(GeneratorBuilder& g) {
    const auto ground = g.field<Int>("ground"), water = g.field<Int>("water");
    const Drainage rivers = g.drainage("rivers", {.spacing = 128, .seaLevel = kSea}, wideLand);
    g.pass2D("land", [&](Pass& p) {
        const Land land = landWithRivers(p, p.drainage(rivers));
        p.set(ground, Int(floor(land.ground)));
        p.set(water, Int(floor(max(land.water, kSea))));
    });
    g.pass3D("blocks", [&](Pass& p) {
        const Block soil = select(p.z() < p.read(ground) - 3, p.block("stone"), p.block("grass"));
        const Block open = select(p.z() <= p.read(water), p.block("water"), p.block("air"));
        p.setBlock(select(p.z() <= p.read(ground), soil, open));
    });
}

}  // namespace terrane::examples
