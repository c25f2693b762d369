#include "terrane/gen/generators/vegetation.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "terrane/gen/language/compounds.h"

namespace terrane::gen::vegetation {

namespace {

std::vector<trees::Kind> kindsOf(const Tables& tables) {
    std::vector<trees::Kind> kinds;
    for (const std::span<const Grove> groves : {tables.trees, tables.small})
        for (const Grove& grove : groves) kinds.push_back(grove.kind);
    kinds.insert(kinds.end(), tables.placed.begin(), tables.placed.end());
    return kinds;
}

}  // namespace

Fields::Fields(GeneratorBuilder& g, const Tables& tables) : kinds(trees::record(g, kindsOf(tables))) {
    if (hasPlants(g.step())) {
        plant = g.field<Block>("plant");
        plantHeight = g.field<Int>("plant height");
    }
    if (g.step() <= kMaxShapeStep) {
        tree = g.field<Int>("tree");
        treeBase = g.field<Int>("tree base");
    }
    if (g.step() <= kMaxSmallStep) small = g.field<Int>("small");
}

namespace {

template <class Entry>
std::vector<Entry> entriesOf(std::span<const Entry> table, int biome) {
    std::vector<Entry> result;
    for (const Entry& entry : table)
        if (entry.biome.value == biome) result.push_back(entry);
    return result;
}

// The biomes of a table, in order.
template <class Entry>
std::vector<int> biomesOf(std::span<const Entry> table) {
    std::vector<int> biomes;
    for (const Entry& entry : table) biomes.push_back(entry.biome.value);
    std::ranges::sort(biomes);
    biomes.erase(std::unique(biomes.begin(), biomes.end()), biomes.end());
    return biomes;
}

// Calls write() once for each of the biomes, in a branch for the columns that have it. Branches are halved:
// rows of one biome come past a few of them.
template <class Write>
void forBiomes(Pass& p, Int biome, std::span<const int> biomes, const Write& write) {
    if (biomes.empty()) return;
    const int first = biomes.front();
    if (biomes.size() == 1) return p.if_(biome == Int(first), [&] { write(first); });
    const std::size_t half = biomes.size() / 2;
    p.if_(
        biome < Int(biomes[half]), [&] { forBiomes(p, biome, biomes.first(half), write); },
        [&] { forBiomes(p, biome, biomes.subspan(half), write); });
}

// The shape at the point, by the groves of its biome; -1 for none.
Int shapeAt(Pass& p, const Fields& f, std::span<const Grove> groves, const Site& site,
            const ScatterPoint& point) {
    const Float chance = p.random2D("kind", point.at.x, point.at.y);
    Var<Int> shape = p.var(Int(-1));
    p.if_(point.isHere, [&] {
        forBiomes(p, site.biome, biomesOf(groves), [&](int biome) {
            const std::vector<Grove> own = entriesOf(groves, biome);
            float below = 0;
            for (const Grove& g : own) below += g.share;
            Int chosen = -1;
            for (auto g = own.rbegin(); g != own.rend(); ++g) {
                chosen = select(chance < site.share * below, trees::shapeOf(of(f.kinds, g->kind), point.hash),
                                chosen);
                below -= g->share;
            }
            shape = chosen;
        });
    });
    return shape;
}

struct Growth {
    Block block;  // or air
    Int height;
};

// Mean crown of a biome's trees, and the share of the ground that crowns cover.
struct Canopy {
    float cover = 0, height = 0;
    std::string_view leaves;
};

Canopy canopyOf(const Fields& f, std::span<const Grove> trees, int biome) {
    Canopy canopy;
    float most = 0;
    for (const Grove& g : entriesOf(trees, biome)) {
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
Growth crownAt(Pass& p, const Fields& f, const Tables& tables, const Site& site) {
    const Float chance = p.random2D("crown", p.x(), p.y()), top = p.random2D("crown top", p.x(), p.y());
    Var<Block> crown = p.var(p.block("air"));
    Var<Int> height = p.var(Int(0));
    for (int b = 0; b < tables.biomes; ++b) {
        const Canopy canopy = canopyOf(f, tables.trees, b);
        if (canopy.cover < 0.004f) continue;
        const Bool isHere = site.biome == Int(b) && chance < site.share * canopy.cover;
        crown = select(isHere, p.block(canopy.leaves), static_cast<Block>(crown));
        height = select(isHere, Int((top * 0.35f + 0.35f) * canopy.height), static_cast<Int>(height));
    }
    return {crown, height};
}

}  // namespace

void setShapes(Pass& p, const Fields& f, const Tables& tables, const Site& site) {
    if (p.step() > kMaxShapeStep) {
        const Growth crown = crownAt(p, f, tables, site);
        p.set(f.plant, crown.block);
        p.set(f.plantHeight, crown.height);
        return;
    }
    p.set(f.treeBase, site.surface + 1);
    Int tree = shapeAt(p, f, tables.trees, site, scatter(p, "trees", kTreeSpacing, 4));
    if (site.placed) tree = select(*site.placed >= 0, *site.placed, tree);
    p.set(f.tree, tree);
    if (p.step() > kMaxSmallStep) return;
    Site low = site;
    low.share = site.smallShare;
    p.set(f.small, shapeAt(p, f, tables.small, low, scatter(p, "small things", kSmallSpacing, 4)));
}

void setPlants(Pass& p, const Fields& f, const Tables& tables, const PlantSite& site) {
    const Float chance = p.random2D("plant", p.x(), p.y());
    const Float meadows = p.perlin2D("meadows", 16, {.5f, 1.0f}) * 0.8f + 1.0f;
    const auto isOn = [&](const char* name) { return site.top == p.block(name); };
    const Bool isEarth = isOn("grass") || isOn("moss") || isOn("mud") || isOn("sand") || isOn("red_sand");
    const Int depth = site.depth;
    Var<Block> plant = p.var(p.block("air"));
    Var<Int> height = p.var(Int(1));
    p.if_(isEarth && site.isFree, [&] {
        forBiomes(p, site.biome, biomesOf(tables.plants), [&](int biome) {
            const std::vector<Plant> own = entriesOf(tables.plants, biome);
            const bool isInWater = std::ranges::any_of(
                tables.inWater, [biome](BiomeNumber other) { return other.value == biome; });
            float below = 0;
            for (const Plant& entry : own) below += entry.share;
            Block chosen = p.block("air");
            for (auto entry = own.rbegin(); entry != own.rend(); ++entry) {
                chosen = select(chance < meadows * below, p.block(entry->block), chosen);
                below -= entry->share;
            }
            const Bool isPlace = isInWater ? depth > 2 && depth < tables.deepest : depth <= 0;
            plant = select(isPlace, chosen, static_cast<Block>(plant));
        });
    });
    const Bool isBank = depth <= 0 && depth >= -2 && site.wet > 0.5f && site.cold > -0.3f;
    p.if_(isBank && isEarth && site.isFree && chance > 0.72f, [&] { plant = p.block("reeds"); });
    p.if_(site.biome == Int(tables.cacti.value) && site.isFree && depth <= 0 && chance > 0.9985f, [&] {
        plant = p.block("cactus");
        height = Int((chance - 0.9985f) * 2600.0f) + 1;
    });
    p.set(f.plant, static_cast<Block>(plant));
    p.set(f.plantHeight, static_cast<Int>(height));
}

Float woodland(Pass& p, Float forest) {
    const Float woods = p.perlin2DWithGrain("woods", 64, {.1f, .2f, .3f, .5f});
    const Float clearings = smoothstep(0.42f, 0.56f, p.perlin2DWithGrain("clearings", 32, {.3f, 1.0f}));
    return forest * (smoothstep(-0.45f, 0.1f, woods) * 0.75f + 0.25f) * (1.0f - clearings * 0.92f);
}

Block aboveGround(Pass& p, const Fields& f, Int surface, Block open) {
    const Block air = p.block("air");
    Block block = open;
    if (hasPlants(p.step())) {
        const Bool isPlant = p.z() <= surface + p.read(f.plantHeight) && p.read(f.plant) != air;
        block = select(isPlant, p.read(f.plant), block);
    }
    if (p.step() <= kMaxSmallStep) {
        const Block small = p.stamp(f.small, f.treeBase);
        block = select(small != air, small, block);
    }
    if (p.step() <= kMaxShapeStep) {
        const Block tree = p.stamp(f.tree, f.treeBase);
        block = select(tree != air, tree, block);
    }
    return block;
}

Block overGround(Pass& p, const Fields& f, Int surface, Block ground) {
    Var<Block> block = p.var(ground);
    p.if_(p.z() > surface, [&] { block = aboveGround(p, f, surface, block); });
    return block;
}

namespace {

// sRGB, 0…1
struct Color {
    float red, green, blue;
};

// From cold to hot, dry and wet.
constexpr Color kDry[] = {{0.52f, 0.53f, 0.36f}, {0.50f, 0.56f, 0.24f}, {0.72f, 0.64f, 0.33f}};
constexpr Color kWet[] = {{0.31f, 0.47f, 0.30f}, {0.31f, 0.51f, 0.17f}, {0.25f, 0.48f, 0.13f}};

}  // namespace

Int grassColor(Pass& p, Float temperature, Float moisture) {
    const Float patches = p.simplex2D("grass colors", 64, {.02f, .03f, .05f, .05f});
    const Float warm = clamp(temperature + patches, -0.6f, 0.6f) * (1.0f / 0.6f);
    const Float wet = smoothstep(-0.5f, 0.4f, moisture + patches);
    const auto channel = [&](float Color::*c) {
        const auto between = [&](const Color(&colors)[3]) {
            const Float cool = lerp(Float(colors[1].*c), Float(colors[0].*c), max(-warm, Float(0.0f)));
            return select(warm < 0.0f, cool,
                          lerp(Float(colors[1].*c), Float(colors[2].*c), max(warm, Float(0.0f))));
        };
        return lerp(between(kDry), between(kWet), wet);
    };
    return packColor(channel(&Color::red), channel(&Color::green), channel(&Color::blue));
}

}  // namespace terrane::gen::vegetation
