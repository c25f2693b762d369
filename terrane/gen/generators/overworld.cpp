// The overworld: seas with beaches, rivers at sea level, plains, hills, deserts with dunes, mountains with
// snow, caves, ore, trees and plants. Five passes: climate and height (2D), surface (2D), ground (3D), plants
// (2D), vegetation (3D).
#include "terrane/gen/generators/catalogue.h"

namespace terrane::gen {
namespace {

constexpr int kSeaLevel = 80;  // z of the highest water
constexpr float kSea = kSeaLevel;
constexpr int kTreeSpacing = 10;    // blocks: one tree a cell of this size at most
constexpr int kMaxPlantReach = 20;  // blocks above the ground that vegetation can reach

// What the passes hand on, by column.
struct Fields {
    explicit Fields(GeneratorBuilder& g)
        : height(g.field<Float>("height")),
          ocean(g.field<Float>("ocean")),
          river(g.field<Float>("river")),
          temperature(g.field<Float>("temperature")),
          desert(g.field<Float>("desert")),
          forest(g.field<Float>("forest")),
          surface(g.field<Int>("surface")),
          top(g.field<Block>("top")),
          soil(g.field<Block>("soil")),
          caveRoof(g.field<Int>("cave roof")),
          treeHeight(g.field<Int>("tree height")),
          plant(g.field<Block>("plant")),
          plantHeight(g.field<Int>("plant height")) {}

    Field<Float> height;       // of the ground, z
    Field<Float> ocean;        // above 0: sea; falls inland
    Field<Float> river;        // 0 in the middle of a river, 1 where no river is felt
    Field<Float> temperature;  // -1…1
    Field<Float> desert;       // 0…1
    Field<Float> forest;       // density of trees, up to about 1
    Field<Int> surface;        // z of the highest ground block
    Field<Block> top, soil;    // the highest ground block, and the few below it
    Field<Int> caveRoof;       // blocks of roof that caves leave standing under the surface
    Field<Int> treeHeight;     // of the trunk that stands in this column, or 0
    Field<Block> plant;        // in this column above the ground, or air
    Field<Int> plantHeight;
};

struct Biomes {
    Float mountains, hills, temperature, desert, fullDesert, forest, ocean;
};

Biomes biomes(Pass& p) {
    const Float mountains = clamp(p.perlin2D("mountainness", 256, {.25f, .5f, 1.0f}) + 0.2f, 0.0f, 1.0f);
    const Float hills = clamp(abs(p.perlin2D("hilliness", 128, {.3f, .5f, .7f})) * 1.6f, 0.0f, 1.0f);
    const Float temperature =
        clamp(p.perlin2D("temperature", 16, {.02f, .02f, .05f, .05f, .2f, .3f, 2.0f}) * 1.3f, -1.0f, 1.0f);
    const Float dry = clamp((temperature - 0.25f) * 2.0f, 0.0f, 1.0f);
    const Float fullDesert = clamp((dry - 0.3f) * 3.0f, 0.0f, 1.0f);
    const Float forest = p.perlin2D("forestness", 64, {.05f, .1f, .2f, .4f}) * 2.0f - dry + 0.1f;
    const Float ocean = p.perlin2D("ocean", 32, {.02f, .01f, 0.0f, 0.0f, 0.0f, 0.0f, 1.8f}) - 0.45f;
    return {mountains, hills, temperature, dry, fullDesert, forest, ocean};
}

// Blocks above the land's base.
Float dunes(Pass& p, const Biomes& b) {
    const Float first = p.voronoi2D("dunes", 56, 2).distance,
                second = p.voronoi2D("more dunes", 56, 2).distance;
    const Float crest = max(first, second) * (1.0f / 56.0f);
    return (crest * 13.0f + p.perlin2D("sand", 64, {2.0f, 5.0f})) * b.fullDesert;
}

// Ridges run where two points of a Voronoi diagram are equally near.
Float mountains(Pass& p, const Biomes& b) {
    const Float ridges = p.voronoi2D("ridges", 512, 2).distance * (1.0f / 512.0f);
    const Float folds = p.voronoi2D("folds", 64, 1).distance * (1.0f / 64.0f);
    const Float roughness = p.perlin2D("roughness", 16, {.25f, .5f, 1.0f});
    return (ridges * 210.0f + folds * 38.0f + roughness * 9.0f - 46.0f) * b.mountains;
}

// 0 in a river, rising to 1 where its valley ends.
Float rivers(Pass& p) {
    const Float distance = abs(p.perlin2D("rivers", 64, {.015f, .03f, .08f, .3f, 1.0f}));
    const Float width = p.perlin2D("river width", 256, {1.0f}) * 0.012f + 0.03f;
    return clamp((distance - width * 0.5f) * 4.5f, -0.06f, 1.0f);
}

// Above 150 blocks over the sea heights approach 168 (z = 248) without reaching it.
Float compressPeaks(Float height) {
    const Float excess = max(height - 110.0f, 0.0f);
    return min(height, 110.0f) + excess * 58.0f / (excess + 58.0f);
}

void climatePass(Pass& p, const Fields& f) {
    const Biomes b = biomes(p);
    const Float inland = smoothstep(0.0f, 0.35f, -b.ocean);
    const Float river = rivers(p);
    const Float base = clamp(p.perlin2D("base", 1024, {.33f, .66f}) + 0.25f, 0.0f, 1.0f) * 30.0f;
    const Float plains = p.perlin2D("plains", 32, {.6f, 1.2f, 2.5f}) + 3.0f;
    const Float hills = (p.perlin2D("hills", 32, {2.0f, 5.0f, 12.0f}) + 10.0f) * b.hills;
    const Float relief = max(max(dunes(p, b), hills), max(mountains(p, b), plains));

    const Float valley = river * river * (Float(3.0f) - 2.0f * river);
    const Float land = compressPeaks((base + relief) * inland) * select(river < 0.0f, Float(0.0f), valley);
    const Float riverBed = min(river, 0.0f) * 75.0f;
    const Float seaFloor = sqrt(max(b.ocean, 0.0f)) * -40.0f;
    const Float beach = 1.5f - smoothstep(-0.004f, 0.02f, b.ocean) * 1.5f;
    // A river runs on into the sea until the floor is as deep as its bed.
    p.set(f.height,
          kSea + beach +
              select(b.ocean > 0.0f, min(seaFloor, riverBed * (1.0f - b.ocean * 8.0f)), land + riverBed));
    p.set(f.ocean, b.ocean);
    p.set(f.river, river);
    p.set(f.temperature, b.temperature);
    p.set(f.desert, b.desert);
    p.set(f.forest, b.forest);
}

Float slope(Pass& p, const Fields& f) {
    const Float dx = p.readAt(f.height, {1, 0}) - p.readAt(f.height, {-1, 0});
    const Float dy = p.readAt(f.height, {0, 1}) - p.readAt(f.height, {0, -1});
    return length({dx * 0.5f, dy * 0.5f});
}

void surfacePass(Pass& p, const Fields& f) {
    const Float height = p.read(f.height), steepness = slope(p, f);
    const Float patches = p.perlin2D("ground patches", 8, {.4f, .3f, .6f});
    const Float snowLine = 164.0f + p.read(f.temperature) * 36.0f + patches * 8.0f;
    const Bool isLow = height < kSea + 2.2f + patches;
    const Bool isSand = p.read(f.desert) > patches * 0.15f + 0.3f;

    Var<Block> top = p.var(p.block("grass"));
    Var<Block> soil = p.var(p.block("dirt"));
    p.if_(steepness > patches * 0.2f + 0.85f, [&] { top = p.block("dirt"); });
    p.if_(isSand || (isLow && p.read(f.ocean) > -0.06f), [&] {
        top = p.block("sand");
        soil = p.block("sand");
    });
    p.if_(height < kSea && p.read(f.ocean) <= -0.06f,
          [&] { top = select(patches > 0.1f, p.block("sand"), p.block("dirt")); });
    p.if_(height > snowLine, [&] { top = p.block("snow"); });
    p.if_(steepness > patches * 0.25f + 1.05f && !isSand, [&] {
        top = p.block("stone");
        soil = p.block("stone");
    });
    const Float entrances = p.perlin2D("cave entrances", 16, {.3f, 1.0f});
    const Bool isWet = height < kSea + 2.0f;
    p.set(f.surface, Int(floor(height)));
    p.set(f.top, static_cast<Block>(top));
    p.set(f.soil, static_cast<Block>(soil));
    p.set(f.caveRoof, select(isWet, Int(10), select(entrances > 0.25f, Int(-1), Int(6))));
}

Bool isCave(Pass& p, const Fields& f) {
    Var<Bool> result = p.var(Bool(false));
    const Bool isBelowRoof = p.z() > 1 && p.z() + p.read(f.caveRoof) < p.read(f.surface);
    p.if_(isBelowRoof, [&] {
        const Float area = p.perlin3D("cave areas", 32, {1.0f});
        p.if_(area > 0.0f, [&] {
            result = p.perlin3D("caves", 8, {.35f, .6f, .8f, 1.0f}) > 0.42f - min(area, 0.2f);
        });
    });
    return result;
}

void groundPass(Pass& p, const Fields& f) {
    const Int z = p.z(), surface = p.read(f.surface);
    const Int depth = surface - z;
    Var<Block> block = p.var(p.block("air"));
    p.if_(
        z <= surface,
        [&] {
            p.if_(
                depth <= 3, [&] { block = select(depth == 0, p.read(f.top), p.read(f.soil)); },
                [&] {
                    const Float ore = p.perlin3D("ore", 4, {1.0f, .5f});
                    block = select(ore > 0.82f, p.block("glowing_ore"), p.block("stone"));
                });
            block = select(isCave(p, f), p.block("air"), static_cast<Block>(block));
        },
        [&] { block = select(z <= kSeaLevel, p.block("water"), p.block("air")); });
    p.setBlock(block);
}

// Trees stand at the points of a Voronoi diagram, so that they keep their distance and a crown meets its
// neighbour's at the border between them.
Voronoi2D trees(Pass& p) {
    return p.voronoi2D("trees", kTreeSpacing, 1);
}

Int treeHeightHere(Pass& p, const Fields& f, Bool isGround) {
    const IVec2 offset = trees(p).offset;
    const Bool isPoint = offset.x == 0 && offset.y == 0;
    const Bool grows = p.random2D("tree grows", p.x(), p.y()) < clamp(p.read(f.forest) * 2.2f, 0.015f, 0.95f);
    const Bool isFertile = isGround && p.read(f.top) == p.block("grass") && slope(p, f) < 0.9f;
    const Int height = Int(p.random2D("tree height", p.x(), p.y()) * 6.0f) + 4;
    return select(isPoint && grows && isFertile, height, Int(0));
}

void plantsPass(Pass& p, const Fields& f) {
    const Int surface = p.read(f.surface);
    const Block top = p.read(f.top);
    const Bool isGround = p.blockInColumn(surface) == top && surface > kSeaLevel;  // not where a cave opens
    const Bool isGrass = isGround && top == p.block("grass");
    const Int tree = treeHeightHere(p, f, isGround);

    const Float chance = p.random2D("plant", p.x(), p.y()), kind = p.random2D("plant kind", p.x(), p.y());
    const Float meadow = p.perlin2D("meadows", 16, {.5f, 1.0f});
    Var<Block> plant = p.var(p.block("air"));
    Var<Int> height = p.var(Int(1));
    p.if_(isGrass, [&] {
        plant = select(chance < 0.10f, p.block("grass_tuft"), p.block("air"));
        p.if_(meadow > 0.35f && chance < 0.16f, [&] {
            const Block flower = select(kind < 0.4f, p.block("poppy"), p.block("oxeye_daisy"));
            plant = select(chance < 0.08f, p.block("grass_tuft"),
                           select(kind < 0.2f, p.block("blue_orchid"), flower));
        });
        p.if_(p.perlin2D("wheat fields", 32, {.3f, 1.0f}) > 0.55f,
              [&] { plant = select(chance < 0.7f, p.block("wheat"), p.block("air")); });
        p.if_(p.read(f.forest) > 0.25f && chance > 0.985f,
              [&] { plant = select(kind < 0.5f, p.block("red_mushroom"), p.block("brown_mushroom")); });
    });
    p.if_(isGround && top == p.block("sand") && p.read(f.desert) > 0.45f && chance < 0.0035f, [&] {
        plant = p.block("cactus");
        height = Int(kind * 4.0f) + 1;
    });
    p.set(f.treeHeight, tree);
    p.set(f.plant, select(tree > 0, p.block("air"), static_cast<Block>(plant)));
    p.set(f.plantHeight, static_cast<Int>(height));
}

// Whether this voxel is leaf of the crown around (0, 0, top), whose size follows the tree's height.
Bool isLeaf(Pass& p, IVec2 offset, Int aboveTop, Int treeHeight) {
    const Float radius = Float(treeHeight) * 0.28f + 1.6f;
    const Float dx(offset.x), dy(offset.y), dz(aboveTop);
    const Float distance = sqrt(dx * dx + dy * dy + dz * dz * 1.7f);
    const Float chance = 1.25f - (distance / radius) * (distance / radius) * 0.75f;
    return distance < radius && p.random3D("leaves", p.x(), p.y(), p.z()) < chance;
}

void vegetationPass(Pass& p, const Fields& f) {
    const IVec2 offset = trees(p).offset;
    const Int z = p.z(), surface = p.read(f.surface);
    const Int treeHeight = p.readAt(f.treeHeight, offset);
    const Int treeBase = p.readAt(f.surface, offset);
    Var<Block> block = p.var(p.blockHere());
    p.if_(z > surface && z <= max(surface + 4, treeBase + kMaxPlantReach), [&] {
        const Bool isOpen = p.blockHere() == p.block("air");
        p.if_(z - surface <= p.read(f.plantHeight),
              [&] { block = select(isOpen, p.read(f.plant), static_cast<Block>(block)); });
        p.if_(treeHeight > 0, [&] {
            const Int aboveBase = z - treeBase;
            const Bool isTrunk = offset.x == 0 && offset.y == 0 && aboveBase <= treeHeight;
            const Bool leaf = aboveBase > 1 && isLeaf(p, offset, aboveBase - treeHeight, treeHeight);
            block = select(leaf && isOpen, p.block("oak_leaves"), static_cast<Block>(block));
            block = select(isTrunk, p.block("oak_log"), static_cast<Block>(block));
        });
    });
    p.if_(z < surface - 4 && z > 1, [&] {
        const Bool isFloor = p.blockHere() == p.block("air") && p.blockInColumn(z - 1) == p.block("stone");
        const Bool grows = p.random3D("cave mushrooms", p.x(), p.y(), z) < 0.025f;
        block = select(isFloor && grows, p.block("glowing_mushroom"), static_cast<Block>(block));
    });
    p.setBlock(block);
}

}  // namespace

void writeOverworld(GeneratorBuilder& g) {
    const Fields f(g);
    g.pass2D("climate", [&](Pass& p) { climatePass(p, f); });
    g.pass2D("surface", [&](Pass& p) { surfacePass(p, f); });
    g.pass3D("ground", [&](Pass& p) { groundPass(p, f); });
    g.pass2D("plants", [&](Pass& p) { plantsPass(p, f); });
    g.pass3D("vegetation", [&](Pass& p) { vegetationPass(p, f); });
}

}  // namespace terrane::gen
