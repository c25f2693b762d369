#include "terrane/gen/generators/overworld.h"

#include <algorithm>

#include "terrane/gen/generators/catalogue.h"

namespace terrane::gen {

// The overworld: seas with beaches and islands, rivers at sea level, plains, hills, deserts with dunes,
// mountain ranges with snow, caves, ore, trees and plants.

void writeOverworld(GeneratorBuilder& g) {
    const overworld::Fields f(g);
    g.pass2D("climate", [&](Pass& p) { climatePass(p, f); });
    g.pass2D("relief", [&](Pass& p) { reliefPass(p, f); });
    g.pass2D("surface", [&](Pass& p) { surfacePass(p, f); });
    if (g.step() > 1) return g.pass3D("far", [&](Pass& p) { farPass(p, f); });
    // Before the 3D passes: neighbors need the positions of trees, and run no later pass for each other.
    g.pass2D("plants", [&](Pass& p) { plantsPass(p, f); });
    g.pass3D("ground", [&](Pass& p) { groundPass(p, f); });
    g.pass3D("vegetation", [&](Pass& p) { vegetationPass(p, f); });
}

}  // namespace terrane::gen

namespace terrane::gen::overworld {

// The overworld where columns are 2, 4, 8 … blocks wide: earth, water, and vegetation as far as it is visible
// from afar. Without caves and ore.

namespace {

// Up to this step single trees stand where they stand at level 0; their crowns are 5 to 9 blocks wide.
constexpr int kMaxTreeStep = 4;
// A trunk of one block may be as wide as a column of this step; beyond it only leaves show.
constexpr int kMaxTrunkStep = 2;

// Blocks. On a slope of 45 degrees the step from one column to the next is as high as the columns are wide.
// The lower part of higher steps needs no cover, as they are only visible from very far away.
constexpr int kMaxCover = 32;

// Vegetation of a column, up to `top`.
struct Growth {
    Int top;
    std::function<Block(Block open)> block;  // at a voxel above the ground; `open` is air or water
};

Bool isGrassAt(Pass& p, const Fields& f, IVec2 offset) {
    return p.readAt(f.top, offset) == p.block("grass") && p.readAt(f.surface, offset) > kSeaLevel;
}

// Depends on the trunk's own position, so that each level has the same tree.
Tree nearestTree(Pass& p, const Fields& f) {
    const IVec2 offset = trees(p).offset, trunk = {p.x() + offset.x, p.y() + offset.y};
    const Bool grows = p.random2D("tree grows", trunk.x, trunk.y) < p.readAt(f.forest, offset);
    const Int height = select(grows && isGrassAt(p, f, offset), randomTreeHeight(p, trunk), Int(0));
    return {offset, p.readAt(f.surface, offset), height};
}

// The crown sampled at the middle of the column. Blocks below it fill the trunk's column, so that no crown
// floats.
Growth treeAndPlant(Pass& p, const Fields& f) {
    const Tree tree = nearestTree(p, f);
    const Plant plant = p.step() == 2 ? plantHere(p, f) : farPlant(p, f);
    const Int half = p.step() / 2, surface = p.read(f.surface);
    const auto isHere = [&](Int offset) { return offset >= -half && offset < half; };
    const Bool isTrunk = isHere(tree.offset.x) && isHere(tree.offset.y) && tree.height > 0;
    const auto voxel = [=, &p] {
        const Int aboveBase = p.z() - tree.base;
        const Bool inCrown = tree.height > 0 && aboveBase > (tree.height >> 1) &&
                             isLeaf(p, tree.offset, aboveBase - tree.height, tree.height);
        const Block trunk = p.block(p.step() <= kMaxTrunkStep ? "oak_log" : "oak_leaves");
        const Block onGround = select(p.z() <= surface + plant.height, plant.block, p.block("air"));
        return multiSelect({{isTrunk && aboveBase <= tree.height, trunk}, {inCrown, p.block("oak_leaves")}},
                           onGround);
    };
    const Int crownTop = select(tree.height > 0, tree.base + tree.height + kMaxCrownRise, Int(0));
    const Int top = max(surface + plant.height, crownTop);
    return {top, [=, &p](Block open) {
                Var<Block> block = p.var(open);
                p.if_(p.z() > max(surface, kSeaLevel) && p.z() <= top, [&] { block = voxel(); });
                return static_cast<Block>(block);
            }};
}

// The share of columns with a crown is the share of the ground that crowns cover at level 0. A crown reaches
// from the ground to about the height where crowns end at level 0.
Growth crownOrPlant(Pass& p, const Fields& f) {
    constexpr float kCrownShare = 0.615f;  // of the ground that a point's tree covers, if it grows
    constexpr int kMinTop = 5, kMaxTop = 12;
    const Plant plant = farPlant(p, f);
    const Bool isCrown =
        isGrassAt(p, f, {0, 0}) && p.random2D("crown", p.x(), p.y()) < p.read(f.forest) * kCrownShare;
    const Int crown = Int(p.random2D("crown top", p.x(), p.y()) * float(kMaxTop - kMinTop + 1)) + kMinTop;
    const Block growth = select(isCrown, p.block("oak_leaves"), plant.block);
    const Int height = select(isCrown, crown, select(plant.block == p.block("air"), Int(0), plant.height));
    const Int top = p.read(f.surface) + height;
    return {top, [=, &p](Block open) { return select(p.z() <= top, growth, open); }};
}

}  // namespace

void farPass(Pass& p, const Fields& f) {
    const Int z = p.z(), surface = p.read(f.surface);
    // Blocks that make the surface of a slope at level 0 lie below each other in one column here.
    const int cover = std::min(p.step(), kMaxCover);
    const Int stoneTop = surface - std::max(kSoilDepth + 1, cover);
    const Growth growth = p.step() <= kMaxTreeStep ? treeAndPlant(p, f) : crownOrPlant(p, f);
    const Block open = select(z <= kSeaLevel, p.block("water"), p.block("air"));
    Var<Block> block = p.var(p.block("stone"));
    // Without branches inside: a select costs less than finding the rows that need it.
    p.if_(z > stoneTop, [&] {
        const Block earth = select(z > surface - cover, p.read(f.top), p.read(f.soil));
        block = select(z > surface, growth.block(open), earth);
    });
    p.setBlock(block);
}

}  // namespace terrane::gen::overworld
