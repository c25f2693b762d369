#include "terrane/gen/generators/catalogue.h"

namespace terrane::gen {

void writeFlat(GeneratorBuilder& g) {
    g.pass3D("ground", [](Pass& p) {
        const Int z = p.z();
        const Block soil = select(z == 80, p.block("grass"), p.block("dirt"));
        const Block ground = select(z <= 76, p.block("stone"), soil);
        p.setBlock(select(z <= 80, ground, p.block("air")));
    });
}

// Land from noise in space: hills with overhangs, arches and floating rocks, grass wherever the sky is near.

namespace {

// Solid where the noise is denser than the height above the middle of the land takes away.
Bool isSolid(Pass& p, Field<Float> middle) {
    const Float above = Float(p.z()) - p.read(middle);
    Var<Bool> solid = p.var(above < 0.0f);
    p.if_(abs(above) < 48.0f, [&] {
        const Float density = p.simplex3D("rock", 24, {.25f, 1.0f}) + p.perlin3D("bulk", 64, {.7f});
        solid = density > above * (1.0f / 34.0f);
    });
    return solid || p.z() == p.heights().bottom;
}

void groundPass(Pass& p, Field<Float> middle) {
    const Block open = select(p.z() <= kSeaLevel, p.block("water"), p.block("air"));
    p.setBlock(select(isSolid(p, middle), p.block("stone"), open));
}

// Grass lies under the open, soil under grass; sand where water is near.
void soilPass(Pass& p) {
    const Int z = p.z();
    const auto isStone = [&](Int at) { return p.blockInColumn(at) == p.block("stone"); };
    const world::Heights heights = p.heights();
    const Bool isInside = z > heights.bottom + 1 && z < heights.top - 1;
    p.if_(p.blockHere() == p.block("stone") && isInside, [&] {
        const Bool isTop = !isStone(z + 1), isSoil = !isStone(z + 3);
        const Block top = select(z <= kSeaLevel + 1, p.block("sand"), p.block("grass"));
        const Block soil = select(z <= kSeaLevel + 1, p.block("sand"), p.block("dirt"));
        p.setBlock(select(isTop, top, select(isSoil, soil, p.block("stone"))));
    });
}

void plantsPass(Pass& p) {
    const Int z = p.z();
    const Bool hasGround = z > p.heights().bottom;
    p.if_(p.blockHere() == p.block("air") && hasGround && p.blockInColumn(z - 1) == p.block("grass"), [&] {
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

// Mountains that are nothing but Voronoi diagrams: bowls with a lake around every point, sharp ridges between
// them, and boxy caves of a diagram in space whose metric makes cells of cubes.

namespace {

constexpr int kSpacing = 96;  // blocks between the points of two bowls, about

// Walls rise with the square of the distance, so that they are steepest at the ridge.
Float bowlHeight(Pass& p) {
    const Float far = p.voronoi2D("bowls", kSpacing, 1).distance * (1.0f / kSpacing);
    const Float fold = p.voronoi2D("folds", 24, 1).distance * (1.0f / 24.0f);
    return 74.0f + far * far * 110.0f + fold * far * 14.0f;
}

void groundPass(Pass& p, Field<Int> height) {
    const Int z = p.z(), top = p.read(height), depth = top - z;
    const Int snowLine = 140 + Int(p.random2D("snow line", p.x(), p.y()) * 6.0f);
    const Block cover = multiSelect(
        {{top <= kSeaLevel + 1, p.block("sand")}, {top > snowLine, p.block("snow")}}, p.block("grass"));
    Var<Block> block = p.var(select(z <= kSeaLevel, p.block("water"), p.block("air")));
    p.if_(depth >= 0, [&] { block = p.block("stone"); });
    p.if_(depth >= 0 && depth < 3, [&] { block = cover; });
    const auto chambers = [&] {
        const Voronoi3D cells = p.voronoi3D("chambers", 28, 1, 8);
        const Bool isChamber = cells.distance < 9.0f && p.perlin3D("where", 64, {1.0f}) > 0.1f;
        const Bool isFloor = cells.offset.z == 8;
        const Block inside = select(isFloor && cells.ratio < 0.3f, p.block("glowing_ore"), p.block("air"));
        p.if_(isChamber, [&] { block = inside; });
    };
    // They are not visible from afar and cost most of the time.
    if (p.step() == 1) p.if_(depth > 6 && z > p.heights().bottom + 3, chambers);
    p.setBlock(block);
}

}  // namespace

void writeVoronoi(GeneratorBuilder& g) {
    const auto height = g.field<Int>("height");
    g.pass2D("bowls", [&](Pass& p) { p.set(height, Int(bowlHeight(p))); });
    g.pass3D("ground", [&](Pass& p) { groundPass(p, height); });
}

}  // namespace terrane::gen
