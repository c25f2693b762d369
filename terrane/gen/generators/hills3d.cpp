// Land from noise in space: hills with overhangs, arches and floating rocks, grass wherever the sky is near.
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/generators/sea_level.h"

namespace terrane::gen {
namespace {

// Solid where the noise is denser than the height above the middle of the land takes away.
Bool isSolid(Pass& p, Field<Float> middle) {
    const Float above = Float(p.z()) - p.read(middle);
    Var<Bool> solid = p.var(above < 0.0f);
    p.if_(abs(above) < 48.0f, [&] {
        const Float density = p.simplex3D("rock", 24, {.25f, 1.0f}) + p.perlin3D("bulk", 64, {.7f});
        solid = density > above * (1.0f / 34.0f);
    });
    return solid || p.z() == 0;
}

void groundPass(Pass& p, Field<Float> middle) {
    const Block open = select(p.z() <= kSeaLevel, p.block("water"), p.block("air"));
    p.setBlock(select(isSolid(p, middle), p.block("stone"), open));
}

// Grass lies under the open, soil under grass; sand where water is near.
void soilPass(Pass& p) {
    const Int z = p.z();
    const auto isStone = [&](Int at) { return p.blockInColumn(at) == p.block("stone"); };
    p.if_(p.blockHere() == p.block("stone") && z > 1 && z < 255, [&] {
        const Bool isTop = !isStone(z + 1), isSoil = !isStone(z + 3);
        const Block top = select(z <= kSeaLevel + 1, p.block("sand"), p.block("grass"));
        const Block soil = select(z <= kSeaLevel + 1, p.block("sand"), p.block("dirt"));
        p.setBlock(select(isTop, top, select(isSoil, soil, p.block("stone"))));
    });
}

void plantsPass(Pass& p) {
    const Int z = p.z();
    p.if_(p.blockHere() == p.block("air") && z > 0 && p.blockInColumn(z - 1) == p.block("grass"), [&] {
        const Float kind = p.random2D("kind", p.x(), p.y());
        const Block flower = multiSelect(
            {{kind < 0.15f, p.block("poppy")}, {kind < 0.3f, p.block("oxeye_daisy")}}, p.block("grass_tuft"));
        p.setBlock(select(p.randomBool3D("grows", 0.12f, p.x(), p.y(), z), flower, p.block("air")));
    });
}

}  // namespace

void writeHills3D(GeneratorBuilder& g) {
    const auto middle = g.field<Float>("middle");
    g.pass2D("land", [&](Pass& p) { p.set(middle, 90.0f + p.simplex2D("land", 256, {7.0f, 20.0f})); });
    g.pass3D("ground", [&](Pass& p) { groundPass(p, middle); });
    g.pass3D("soil", soilPass);
    // A flower as wide as a column of 4 blocks would be a tree.
    if (g.step() <= 2) g.pass3D("plants", plantsPass);
}

}  // namespace terrane::gen
