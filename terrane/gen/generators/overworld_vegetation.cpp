// Trees and plants of the overworld. 2D passes decide where they stand, so that neighbors, into which crowns
// reach, need no blocks of each other. The 3D pass leaves out plants whose ground a cave cut away.
#include "terrane/gen/generators/overworld.h"

namespace terrane::gen::overworld {

Bool isLeaf(Pass& p, IVec2 offset, Int aboveTop, Int treeHeight) {
    const Float radius = Float(treeHeight) * 0.3f + 1.7f;
    const Float dx(offset.x), dy(offset.y), dz(aboveTop);
    const Float distance = sqrt(dx * dx + dy * dy + dz * dz * 1.7f);
    const Float chance = 1.25f - (distance / radius) * (distance / radius) * 0.75f;
    return distance < radius && p.random3D("leaves", p.x(), p.y(), p.z()) < chance;
}

Voronoi2D trees(Pass& p) {
    return p.voronoi2D("trees", kTreeSpacing, 1);
}

Int randomTreeHeight(Pass& p, IVec2 at) {
    constexpr int kMin = 3, kMax = 10;
    return Int(p.random2D("tree height", at.x, at.y) * float(kMax - kMin + 1)) + kMin;
}

namespace {

constexpr float kWheatShare = 0.75f;  // of a field's columns

Bool isGrass(Pass& p, const Fields& f) {
    return p.read(f.surface) > kSeaLevel && p.read(f.top) == p.block("grass");
}

Bool isWheatField(Pass& p, const Fields& f, Bool isFlat) {
    return p.perlin2DWithGrain("wheat fields", 16, {.15f, .3f, 1.0f}) > 0.55f && isFlat &&
           p.read(f.surface) < kSeaLevel + 35 && p.read(f.forest) < 0.1f;
}

Block plantOnGrass(Pass& p, const Fields& f, Float chance, Float kind) {
    const Float meadow = p.perlin2D("meadows", 16, {.5f, 1.0f});
    const Block air = p.block("air"), tuft = p.block("grass_tuft");
    Var<Block> plant = p.var(select(chance < 0.07f + meadow * 0.06f, tuft, air));
    p.if_(meadow > 0.4f && chance > 0.9f, [&] {
        const Block flower = select(kind < 0.6f, p.block("poppy"), p.block("oxeye_daisy"));
        plant = select(kind < 0.2f, p.block("blue_orchid"), flower);
    });
    const auto rise = [&](int dx, int dy) {
        return abs(p.readAt(f.surface, {dx, dy}) - p.readAt(f.surface, {-dx, -dy}));
    };
    const Bool isFlat = rise(3, 0) + rise(0, 3) <= 1;
    p.if_(isWheatField(p, f, isFlat), [&] { plant = select(chance < kWheatShare, p.block("wheat"), air); });
    p.if_(p.read(f.forest) > 0.5f && chance > 0.985f,
          [&] { plant = select(kind < 0.5f, p.block("red_mushroom"), p.block("brown_mushroom")); });
    return plant;
}

// No cave cuts the blocks that carry a plant.
Bool isSolidGround(Pass& p, const Fields& f) {
    const Int surface = p.read(f.surface);
    const Block air = p.block("air");
    return p.blockInColumn(surface) != air && p.blockInColumn(surface - 1) != air &&
           p.blockInColumn(surface - 3) != air;
}

// Trees keep away from cave mouths: no cave can reach their ground.
Int treeHeightHere(Pass& p, const Fields& f, Bool isGrass) {
    const Bool isFarFromCaves = p.read(f.caveTop) < p.read(f.surface) - 3;
    const IVec2 offset = trees(p).offset;
    const Bool isPoint = offset.x == 0 && offset.y == 0;
    const Bool grows = p.random2D("tree grows", p.x(), p.y()) < p.read(f.forest);
    const Int height = randomTreeHeight(p, {p.x(), p.y()});
    return select(isPoint && grows && isGrass && isFarFromCaves, height, Int(0));
}

// A voxel from the soil up to the highest leaf.
Block vegetation(Pass& p, const Fields& f, const Tree& tree) {
    const Int z = p.z(), surface = p.read(f.surface);
    const Block air = p.block("air");
    Var<Block> block = p.var(p.blockHere());
    p.if_(z <= surface, [&] {
        const Bool hangs = p.blockInColumn(z - 1) == air && p.blockHere() == p.block("sand");
        block = select(hangs, p.block("stone"), static_cast<Block>(block));
    });
    p.if_(z > surface && p.blockHere() == air, [&] {
        const Bool isPlant = z <= surface + p.read(f.plantHeight) && isSolidGround(p, f);
        block = select(isPlant, p.read(f.plant), air);
        const Int aboveBase = z - tree.base;
        p.if_(tree.height > 0 && aboveBase > (tree.height >> 1), [&] {
            const Bool leaf = isLeaf(p, tree.offset, aboveBase - tree.height, tree.height);
            block = select(leaf, p.block("oak_leaves"), static_cast<Block>(block));
        });
        const Bool isTrunk = tree.offset.x == 0 && tree.offset.y == 0 && tree.height > 0;
        block = select(isTrunk && aboveBase <= tree.height, p.block("oak_log"), static_cast<Block>(block));
    });
    return block;
}

Block caveFloor(Pass& p) {
    const Bool isFloor = p.blockInColumn(p.z() - 1) == p.block("stone");
    const Bool grows = p.random3D("cave mushrooms", p.x(), p.y(), p.z()) < 0.025f;
    return select(isFloor && grows, p.block("glowing_mushroom"), p.block("air"));
}

}  // namespace

Plant plantHere(Pass& p, const Fields& f) {
    const Float chance = p.random2D("plant", p.x(), p.y()), kind = p.random2D("plant kind", p.x(), p.y());
    Var<Block> plant = p.var(p.block("air"));
    Var<Int> height = p.var(Int(1));
    p.if_(isGrass(p, f), [&] { plant = plantOnGrass(p, f, chance, kind); });
    const Bool isDesert =
        p.read(f.surface) > kSeaLevel && p.read(f.top) == p.block("sand") && p.read(f.desert) > 0.5f;
    p.if_(isDesert && chance < 0.0014f, [&] {
        plant = p.block("cactus");
        height = Int(kind * 4.0f) + 1;
    });
    return {plant, height};
}

Plant farPlant(Pass& p, const Fields& f) {
    const Vec2 slope = p.slope(f.height);
    const Bool isFlat = abs(slope.x) + abs(slope.y) < 0.25f;
    Var<Block> plant = p.var(p.block("air"));
    p.if_(isGrass(p, f) && p.random2D("plant", p.x(), p.y()) < kWheatShare,
          [&] { plant = select(isWheatField(p, f, isFlat), p.block("wheat"), p.block("air")); });
    return {plant, 1};
}

void plantsPass(Pass& p, const Fields& f) {
    const Int tree = treeHeightHere(p, f, isGrass(p, f));

    const Plant plant = plantHere(p, f);
    p.set(f.treeHeight, tree);
    p.set(f.plant, select(tree > 0, p.block("air"), plant.block));
    p.set(f.plantHeight, plant.height);
}

void vegetationPass(Pass& p, const Fields& f) {
    const IVec2 offset = trees(p).offset;
    const Tree tree = {offset, p.readAt(f.surface, offset), p.readAt(f.treeHeight, offset)};
    const Int z = p.z(), surface = p.read(f.surface);
    const Int highest = max(surface + p.read(f.plantHeight),
                            select(tree.height > 0, tree.base + tree.height + kMaxCrownRise, Int(0)));
    Var<Block> block = p.var(p.blockHere());
    // The fewer conditions most voxels meet, the faster.
    p.if_(
        z >= surface - kSoilDepth, [&] { p.if_(z <= highest, [&] { block = vegetation(p, f, tree); }); },
        [&] { p.if_(p.blockHere() == p.block("air"), [&] { block = caveFloor(p); }); });
    p.setBlock(block);
}

}  // namespace terrane::gen::overworld
