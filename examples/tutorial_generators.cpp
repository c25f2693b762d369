// The generators of the tutorial in docs/worldgen.md, step by step.
#include "examples/tutorial_generators.h"

namespace terrane::examples {

using namespace gen;

// Step 1: flat land.
void writeStep1(GeneratorBuilder& g) {
    g.pass3D("ground", [](Pass& p) { p.setBlock(select(p.z() <= 80, p.block("grass"), p.block("air"))); });
}

// Step 2: hills and lakes. A 2D pass computes the height once a column.
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

// Steepness from the heights around, snow on high land.
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

// Step 4: caves. Noise in space is costly: it stands in an if_, so that layers of air and water skip it.
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
    // A last pass that sees what the caves left: mushrooms on their floors, tufts on the grass.
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

}  // namespace terrane::examples
