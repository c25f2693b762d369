#include "terrane/gen/generators/continents_plants.h"

#include <algorithm>

#include "terrane/gen/language/compounds.h"

namespace terrane::gen::continents {

namespace {

using trees::Kind;

constexpr Grove kTrees[] = {
    {Biome::Meadow, Kind::Oak, 0.018f},         {Biome::Meadow, Kind::Birch, 0.008f},
    {Biome::OakForest, Kind::Oak, 0.62f},       {Biome::OakForest, Kind::Birch, 0.12f},
    {Biome::BirchForest, Kind::Birch, 0.66f},   {Biome::BirchForest, Kind::Oak, 0.06f},
    {Biome::BirchForest, Kind::Spruce, 0.05f},  {Biome::OldForest, Kind::OldOak, 0.17f},
    {Biome::OldForest, Kind::Oak, 0.46f},       {Biome::OldForest, Kind::GiantMushroom, 0.012f},
    {Biome::Taiga, Kind::Spruce, 0.46f},        {Biome::Taiga, Kind::Pine, 0.16f},
    {Biome::Taiga, Kind::Larch, 0.13f},         {Biome::Tundra, Kind::Spruce, 0.014f},
    {Biome::Tundra, Kind::DeadTree, 0.005f},    {Biome::Snow, Kind::Spruce, 0.05f},
    {Biome::Savanna, Kind::Acacia, 0.07f},      {Biome::Savanna, Kind::Baobab, 0.007f},
    {Biome::Desert, Kind::DeadTree, 0.0012f},   {Biome::CanyonLand, Kind::Pine, 0.03f},
    {Biome::CanyonLand, Kind::DeadTree, 0.01f}, {Biome::Swamp, Kind::Willow, 0.26f},
    {Biome::Swamp, Kind::Cypress, 0.24f},       {Biome::Alpine, Kind::Pine, 0.10f},
    {Biome::Alpine, Kind::Larch, 0.06f},        {Biome::RainForest, Kind::Palm, 0.26f},
    {Biome::RainForest, Kind::OldOak, 0.13f},   {Biome::RainForest, Kind::Oak, 0.3f},
    {Biome::Beach, Kind::Palm, 0.08f},
};

constexpr Grove kSmall[] = {
    {Biome::Meadow, Kind::Bush, 0.05f},         {Biome::Meadow, Kind::Boulder, 0.006f},
    {Biome::OakForest, Kind::Bush, 0.12f},      {Biome::OakForest, Kind::FallenLog, 0.02f},
    {Biome::BirchForest, Kind::Bush, 0.06f},    {Biome::BirchForest, Kind::FallenLog, 0.015f},
    {Biome::OldForest, Kind::FallenLog, 0.04f}, {Biome::OldForest, Kind::Bush, 0.12f},
    {Biome::OldForest, Kind::Boulder, 0.012f},  {Biome::Taiga, Kind::Boulder, 0.02f},
    {Biome::Taiga, Kind::FallenLog, 0.015f},    {Biome::Tundra, Kind::Boulder, 0.03f},
    {Biome::Snow, Kind::Boulder, 0.01f},        {Biome::Savanna, Kind::Bush, 0.05f},
    {Biome::Savanna, Kind::Boulder, 0.006f},    {Biome::CanyonLand, Kind::Bush, 0.04f},
    {Biome::CanyonLand, Kind::Boulder, 0.02f},  {Biome::Swamp, Kind::Bush, 0.06f},
    {Biome::Swamp, Kind::FallenLog, 0.02f},     {Biome::Alpine, Kind::Boulder, 0.035f},
    {Biome::RainForest, Kind::Bush, 0.2f},      {Biome::Desert, Kind::Boulder, 0.004f},
};

constexpr Plant kPlants[] = {
    {Biome::Meadow, "tall_grass", 0.20f},
    {Biome::Meadow, "grass_tuft", 0.24f},
    {Biome::Meadow, "oxeye_daisy", 0.03f},
    {Biome::Meadow, "poppy", 0.02f},
    {Biome::Meadow, "bluebell", 0.02f},
    {Biome::OakForest, "grass_tuft", 0.14f},
    {Biome::OakForest, "fern", 0.04f},
    {Biome::OakForest, "brown_mushroom", 0.003f},
    {Biome::BirchForest, "grass_tuft", 0.18f},
    {Biome::BirchForest, "bluebell", 0.05f},
    {Biome::OldForest, "fern", 0.20f},
    {Biome::OldForest, "red_mushroom", 0.008f},
    {Biome::Taiga, "fern", 0.10f},
    {Biome::Taiga, "grass_tuft", 0.05f},
    {Biome::Tundra, "heather", 0.16f},
    {Biome::Tundra, "grass_tuft", 0.06f},
    {Biome::Savanna, "savanna_grass", 0.50f},
    {Biome::CanyonLand, "dead_bush", 0.012f},
    {Biome::CanyonLand, "savanna_grass", 0.03f},
    {Biome::Desert, "dead_bush", 0.004f},
    {Biome::Swamp, "tall_grass", 0.22f},
    {Biome::Swamp, "fern", 0.08f},
    {Biome::Alpine, "grass_tuft", 0.14f},
    {Biome::Alpine, "heather", 0.08f},
    {Biome::Alpine, "bluebell", 0.02f},
    {Biome::RainForest, "fern", 0.30f},
    {Biome::RainForest, "tall_grass", 0.14f},
    {Biome::RainForest, "blue_orchid", 0.012f},
    {Biome::Reef, "seagrass", 0.05f},
    {Biome::Reef, "coral_red", 0.04f},
    {Biome::Reef, "coral_yellow", 0.03f},
    {Biome::Ocean, "seagrass", 0.015f},
};

}  // namespace

std::span<const Grove> treeGroves() {
    return kTrees;
}

std::span<const Grove> smallGroves() {
    return kSmall;
}

std::span<const Plant> plants() {
    return kPlants;
}

std::vector<Kind> groveKinds() {
    std::vector<Kind> kinds;
    for (const Grove& grove : kTrees) kinds.push_back(grove.kind);
    for (const Grove& grove : kSmall) kinds.push_back(grove.kind);
    return kinds;
}

// Vegetation of continents: positions of trees, bushes, stones and plants (2D), and their blocks (3D).

namespace {

std::vector<Grove> grovesOf(std::span<const Grove> groves, Biome biome) {
    std::vector<Grove> result;
    for (const Grove& g : groves)
        if (g.biome == biome) result.push_back(g);
    return result;
}

// 0…1: the share of the densities in the tables that woods and clearings leave.
Float density(Pass& p, const Fields& f) {
    const Float woods = p.perlin2DWithGrain("woods", 64, {.1f, .2f, .3f, .5f});
    const Float clearings = smoothstep(0.42f, 0.56f, p.perlin2DWithGrain("clearings", 32, {.3f, 1.0f}));
    return p.read(f.forest) * (smoothstep(-0.45f, 0.1f, woods) * 0.75f + 0.25f) * (1.0f - clearings * 0.92f);
}

// Trees stand on earth that no cave is near. On beaches only where it is warm, in mountains up to the tree
// line.
Bool canGrow(Pass& p, const Fields& f) {
    const Block top = p.read(f.top);
    const auto is = [&](const char* name) { return top == p.block(name); };
    const Bool isEarth =
        is("grass") || is("moss") || is("mud") || is("snow") || is("sand") || is("red_sand") || is("gravel");
    const Float cold = p.read(f.cold);
    const Bool isWarmBeach = p.read(f.biome) != number(Biome::Beach) || cold > 0.18f;
    const Bool isBelowTreeLine = p.read(f.biome) != number(Biome::Alpine) || cold > -0.3f;
    Bool result = isEarth && isWarmBeach && isBelowTreeLine && p.read(f.surface) >= p.read(f.water);
    if (p.step() == 1) result = result && p.read(f.caveTop) < p.read(f.surface) - 3;
    return result;
}

// The shape at the point, by the groves of its biome; -1 for none.
Int shapeAt(Pass& p, const Fields& f, std::span<const Grove> groves, const ScatterPoint& point, Float share) {
    const Float chance = p.random2D("kind", point.at.x, point.at.y);
    Var<Int> shape = p.var(Int(-1));
    for (int b = 0; b < static_cast<int>(Biome::Count); ++b) {
        const std::vector<Grove> own = grovesOf(groves, static_cast<Biome>(b));
        if (own.empty()) continue;
        p.if_(point.isHere && p.read(f.biome) == Int(b), [&] {
            float below = 0;
            for (const Grove& g : own) below += g.share;
            Int chosen = -1;
            for (auto g = own.rbegin(); g != own.rend(); ++g) {
                chosen =
                    select(chance < share * below, trees::shapeOf(of(f.kinds, g->kind), point.hash), chosen);
                below -= g->share;
            }
            shape = chosen;
        });
    }
    return shape;
}

struct Growth {
    Block block;
    Int height;
};

Growth plantAt(Pass& p, const Fields& f) {
    const Float chance = p.random2D("plant", p.x(), p.y());
    const Float meadows = p.perlin2D("meadows", 16, {.5f, 1.0f}) * 0.8f + 1.0f;
    const Block top = p.read(f.top);
    const auto isOn = [&](const char* name) { return top == p.block(name); };
    const Bool isEarth = isOn("grass") || isOn("moss") || isOn("mud") || isOn("sand") || isOn("red_sand");
    const Bool isFree = p.read(f.caveTop) < p.read(f.surface) - 3;
    const Int depth = p.read(f.water) - p.read(f.surface);
    Var<Block> plant = p.var(p.block("air"));
    Var<Int> height = p.var(Int(1));
    for (int b = 0; b < static_cast<int>(Biome::Count); ++b) {
        const bool growsInWater = b == static_cast<int>(Biome::Reef) || b == static_cast<int>(Biome::Ocean);
        const Bool isPlace = growsInWater ? depth > 2 && depth < 20 : depth <= 0;
        p.if_(p.read(f.biome) == Int(b) && isPlace && isEarth && isFree, [&] {
            float below = 0;
            for (const Plant& entry : plants())
                if (entry.biome == static_cast<Biome>(b)) below += entry.share;
            Block chosen = p.block("air");
            for (auto entry = plants().rbegin(); entry != plants().rend(); ++entry) {
                if (entry->biome != static_cast<Biome>(b)) continue;
                chosen = select(chance < meadows * below, p.block(entry->block), chosen);
                below -= entry->share;
            }
            plant = chosen;
        });
    }
    const Bool isBank = depth <= 0 && depth >= -2 && p.read(f.wet) > 0.5f && p.read(f.cold) > -0.3f;
    p.if_(isBank && isEarth && isFree && chance > 0.72f, [&] { plant = p.block("reeds"); });
    p.if_(p.read(f.biome) == number(Biome::Desert) && isFree && depth <= 0 && chance > 0.9985f, [&] {
        plant = p.block("cactus");
        height = Int((chance - 0.9985f) * 2600.0f) + 1;
    });
    return {plant, height};
}

// Mean crown of a biome's trees, and the share of the ground that crowns cover.
struct Canopy {
    float cover = 0, height = 0;
    std::string_view leaves;
};

Canopy canopyOf(const Fields& f, Biome biome) {
    Canopy canopy;
    float most = 0;
    for (const Grove& g : grovesOf(treeGroves(), biome)) {
        const trees::KindRecord& kind = of(f.kinds, g.kind);
        const float cover = g.share * kind.cover / static_cast<float>(kTreeSpacing * kTreeSpacing);
        canopy.cover += cover;
        canopy.height += cover * kind.height;
        if (cover > most) canopy.leaves = kind.leaves;
        most = std::max(most, cover);
    }
    if (canopy.cover > 0) canopy.height /= canopy.cover;
    // Crowns overlap where they are many.
    canopy.cover = canopy.cover / (1.0f + 0.35f * canopy.cover);
    return canopy;
}

// The share of columns with a crown is the share of the ground that crowns cover at level 0. A crown reaches
// from the ground to about the height where crowns end at level 0.
Growth crownAt(Pass& p, const Fields& f, Float share) {
    const Float chance = p.random2D("crown", p.x(), p.y()), top = p.random2D("crown top", p.x(), p.y());
    Var<Block> crown = p.var(p.block("air"));
    Var<Int> height = p.var(Int(0));
    for (int b = 0; b < static_cast<int>(Biome::Count); ++b) {
        const Canopy canopy = canopyOf(f, static_cast<Biome>(b));
        if (canopy.cover < 0.004f) continue;
        const Bool isHere = p.read(f.biome) == Int(b) && chance < share * canopy.cover;
        crown = select(isHere, p.block(canopy.leaves), static_cast<Block>(crown));
        height = select(isHere, Int((top * 0.35f + 0.35f) * canopy.height), static_cast<Int>(height));
    }
    return {crown, height};
}

}  // namespace

void plantsPass(Pass& p, const Fields& f) {
    const Float share = select(canGrow(p, f), density(p, f), Float(0.0f));
    if (p.step() > kMaxShapeStep) {
        const Growth crown = crownAt(p, f, share);
        p.set(f.plant, crown.block);
        p.set(f.plantHeight, crown.height);
        return;
    }
    p.set(f.treeBase, p.read(f.surface) + 1);
    p.set(f.tree, shapeAt(p, f, treeGroves(), scatter(p, "trees", kTreeSpacing, 4), share));
    if (p.step() > kMaxSmallStep) return;
    p.set(f.small, shapeAt(p, f, smallGroves(), scatter(p, "small things", kSmallSpacing, 4), share));
    if (p.step() > 1) return;
    const Growth plant = plantAt(p, f);
    p.set(f.plant, plant.block);
    p.set(f.plantHeight, plant.height);
}

void landPass(Pass& p, const Fields& f) {
    const Int surface = p.read(f.surface);
    const Block air = p.block("air");
    Var<Block> block = p.var(ground(p, f));
    p.if_(p.z() > surface, [&] {
        if (hasPlants(p.step())) {
            const Bool isPlant = p.z() <= surface + p.read(f.plantHeight) && p.read(f.plant) != air;
            block = select(isPlant, p.read(f.plant), static_cast<Block>(block));
        }
        if (p.step() <= kMaxSmallStep) {
            const Block small = p.stamp(f.small, f.treeBase);
            block = select(small != air, small, static_cast<Block>(block));
        }
        if (p.step() <= kMaxShapeStep) {
            const Block tree = p.stamp(f.tree, f.treeBase);
            block = select(tree != air, tree, static_cast<Block>(block));
        }
    });
    p.setBlock(block);
}

void caveLifePass(Pass& p, const Fields& f) {
    Var<Block> block = p.var(p.blockHere());
    p.if_(p.z() < p.read(f.caveTop) && p.blockHere() == p.block("air"), [&] {
        const Block below = p.blockInColumn(p.z() - 1);
        const Bool isFloor = below != p.block("air") && below != p.block("water");
        const Float chance = p.random3D("cave life", p.x(), p.y(), p.z());
        const Block grown = multiSelect({{chance < 0.012f && p.z() < 40, p.block("crystal")},
                                         {chance < 0.04f, p.block("glowing_mushroom")},
                                         {chance < 0.05f, p.block("brown_mushroom")}},
                                        p.block("air"));
        block = select(isFloor, grown, static_cast<Block>(block));
    });
    p.setBlock(block);
}

}  // namespace terrane::gen::continents
