#include "terrane/gen/generators/continents.h"
#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/language/compounds.h"

namespace terrane::gen::continents {

// The ground of continents: gullies, terraces, dunes, karst towers, on the forms of continents.cpp.

namespace {

// Peaks stay below the top of the world, however much comes together in one place.
Float belowTheTop(Float height) {
    constexpr float kFrom = 205.0f, kRoom = 38.0f;  // z, blocks
    const Float above = max(height - kFrom, Float(0.0f));
    return min(height, Float(kFrom)) + above * kRoom / (above + kRoom);
}

struct Relief {
    Float height, rocky;
};

Relief relief(Pass& p, const Fields& f) {
    const Float temperature = p.read(f.temperature), moisture = p.read(f.moisture), land = p.read(f.land);
    const Float mountains = p.read(f.mountains), base = p.read(f.base);
    const Float inland = smoothstep(0.015f, 0.09f, land), flat = 1.0f - smoothstep(0.05f, 0.3f, mountains);
    const Float erosion = inland * smoothstep(kSea + 1.0f, kSea + 24.0f, base) *
                          (max(mountains, p.read(f.volcanic)) * 0.65f + 0.35f);
    Var<Float> gullies = p.var(Float(0.0f));
    p.if_(erosion > 0.0f, [&] {
        gullies = erode(p, "gullies", p.slope(f.base), erosion,
                        {.size = 128, .octaves = 5, .depth = 0.22f, .fullSlope = 0.4f})
                      .height;
    });
    Var<Float> height = p.var(base + gullies + smoothstep(0.0f, 0.4f, mountains) * 13.0f);
    Var<Float> rocky = p.var(Float(0.0f));
    const Float canyon = canyonLand(temperature, moisture) * inland * flat;
    p.if_(canyon > 0.0f, [&] {
        height = height + landforms::tables(p) * canyon;
        rocky = canyon;
    });
    const Float sand = desert(temperature, moisture) * inland * flat;
    p.if_(sand > 0.0f, [&] { height = height + landforms::dunes(p) * sand; });
    const Float limestone = karst(temperature, moisture) * inland * flat *
                            smoothstep(0.05f, 0.3f, p.simplex2D("karst", 256, {.4f, 1.0f}));
    p.if_(limestone > 0.0f, [&] {
        const Float tower = landforms::towers(p) * limestone;
        height = height + tower;
        rocky = max(rocky, smoothstep(3.0f, 10.0f, tower));
    });
    const Float bumps = p.perlin2D("bumps", 8, {.25f, .5f, 1.0f, 1.4f});
    return {height + bumps * (inland * 0.8f + 0.25f), rocky};
}

}  // namespace

void reliefPass(Pass& p, const Fields& f) {
    const Relief r = relief(p, f);
    const RiverCut w = cutRivers(p, f, belowTheTop(r.height));
    const Float height = max(w.height, Float(6.0f));
    p.set(f.height, height);
    p.set(f.rocky, r.rocky);
    p.set(f.water, w.water);
    p.set(f.wet, w.isWater);
    p.set(f.surface, Int(floor(height)));
}

// Rivers and lakes of continents: valleys, beds, banks and basins, where the drainage map has water.

namespace {

constexpr float kReach = 160.0f;  // blocks from the middle of a river to where its valley ends

}  // namespace

Drainage rivers(GeneratorBuilder& g) {
    return g.drainage("rivers",
                      {.spacing = 256,
                       .seaLevel = kSea + 0.5f,
                       .minFlow = 5,
                       .halfWidth = 2.2f,
                       .maxHalfWidth = 13.0f,
                       .reach = kReach,
                       .lakeDepth = 3.0f,
                       .lakeNodes = 2},
                      coarseHeight);
}

RiverCut cutRivers(Pass& p, const Fields& f, Float height) {
    RiverCut result{height, kSeaLevel, 0.0f};
    if (p.step() > kMaxDrainageStep) return result;
    const DrainageSample r = p.drainage(f.rivers);
    // Toward the coast the water comes down to the sea before the land ends.
    const Float level = min(r.level, max((p.read(f.land) - 0.012f) * 300.0f, Float(0.0f)) + (kSea + 0.5f));
    // Shores and banks are not as smooth as the map.
    const Float rough = p.perlin2D("banks", 8, {.5f, 1.0f, 1.5f});
    const Float fromBank = r.distance - r.halfWidth + rough * 0.4f;
    Var<Float> ground = p.var(height);
    Var<Int> water = p.var(Int(kSeaLevel));
    Var<Float> wet = p.var(Float(0.0f));
    p.if_(r.distance < kReach, [&] {
        // The wider the river and the flatter the land, the wider the valley's floor.
        const Float floorWidth = r.halfWidth * 1.5f + 2.0f;
        const Float rise = clamp((fromBank - floorWidth) / (kReach - 24.0f - floorWidth), 0.0f, 1.0f);
        const Float valley = rise * rise * (3.0f - 2.0f * rise);
        const Float bank = level + 1.3f + clamp(fromBank * 0.12f, 0.0f, 1.5f);
        const Float across = clamp(r.distance / max(r.halfWidth, Float(1.0f)), 0.0f, 1.0f);
        const Float bed = level - 0.6f - (1.0f - across * across) * (r.halfWidth * 0.35f + 0.8f);
        // Water above the sea needs banks; at the sea's level the ground may be lower beside it.
        const Float raised = lerp(min(bank, height), bank, clamp((level - kSea - 0.5f) * 2.0f, 0.0f, 1.0f));
        const Float outside = lerp(raised, max(height, min(raised, level + 1.3f)), valley);
        ground = select(fromBank < 0.0f, min(bed, height), outside);
        water = select(fromBank < 0.0f, max(Int(floor(level)), Int(kSeaLevel)), Int(kSeaLevel));
        wet = smoothstep(12.0f, 2.0f, fromBank);
    });
    p.if_(r.lakeDistance < 48.0f, [&] {
        const Float fromShore = r.lakeDistance + rough * 3.0f;
        const Float shore = r.lakeLevel + 1.2f + clamp(fromShore * 0.1f, 0.0f, 2.0f);
        const Float outside =
            lerp(shore, max(static_cast<Float>(ground), shore), smoothstep(0.0f, 40.0f, fromShore));
        const Float bed = r.lakeLevel - 0.8f - min(fromShore * -0.22f, Float(11.0f));
        ground = select(fromShore < 0.0f, bed, outside);
        water =
            select(fromShore < 0.0f, max(Int(floor(r.lakeLevel)), Int(kSeaLevel)), static_cast<Int>(water));
        wet = max(static_cast<Float>(wet), smoothstep(10.0f, 2.0f, fromShore));
    });
    return {ground, water, wet};
}

}  // namespace terrane::gen::continents
