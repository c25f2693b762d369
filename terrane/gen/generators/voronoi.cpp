// Mountains that are nothing but Voronoi diagrams: bowls with a lake around every point, sharp ridges between
// them, and boxy caves of a diagram in space whose metric makes cells of cubes.
#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/generators/sea_level.h"

namespace terrane::gen {
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
    if (p.step() == 1) p.if_(depth > 6 && z > 3, chambers);
    p.setBlock(block);
}

}  // namespace

void writeVoronoi(GeneratorBuilder& g) {
    const auto height = g.field<Int>("height");
    g.pass2D("bowls", [&](Pass& p) { p.set(height, Int(bowlHeight(p))); });
    g.pass3D("ground", [&](Pass& p) { groundPass(p, height); });
}

}  // namespace terrane::gen
