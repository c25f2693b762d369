#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/generators/wilderness.h"
#include "terrane/gen/language/compounds.h"

// The ground of wilderness: slopes between streams, gullies, coasts, the sea floor, rivers and lakes.

namespace terrane::gen::wilderness {

namespace {

// The smaller of two numbers, rounded where they are less than `round` apart.
Float smoothMin(Float a, Float b, float round) {
    const Float t = clamp((b - a) * (0.5f / round) + 0.5f, 0.0f, 1.0f);
    return lerp(b, a, t) - t * (1.0f - t) * round;
}
Float smoothMax(Float a, Float b, float round) {
    return -smoothMin(-a, -b, round);
}

// z of the sea floor: a shelf, its slope, the deep sea with ridges and trenches.
Float seaFloor(Pass& p, Float land) {
    const Float shelf = smoothstep(0.0f, -0.12f, land) * -26.0f;
    const Float slope = smoothstep(-0.1f, -0.38f, land) * -170.0f;
    const Float deep = smoothstep(-0.3f, -0.8f, land) * -90.0f;
    const Float lines = p.simplex2D("sea ridges", 256, {.15f, .3f, .6f, 1.0f});
    const Float ridges = smoothstep(0.35f, 0.0f, abs(lines)) * 60.0f;
    const Float trenches = smoothstep(0.12f, 0.0f, abs(lines - 0.55f)) * -110.0f;
    return kSea + shelf + slope + deep + (ridges + trenches) * smoothstep(-0.2f, -0.45f, land) - 0.5f;
}

// Valleys that glaciers deepened, by column.
struct Ice {
    Float share;  // of a range that was cold enough
    Float main;   // share: a main valley rather than one that leads to it
    Float flow;   // of the stream
};

Ice iceOf(Pass& p, const Fields& f, Float flow) {
    return {smoothstep(0.08f, -0.12f, p.read(f.temperature)) * smoothstep(0.25f, 0.5f, p.read(f.range)),
            smoothstep(3.0f, 12.0f, flow), flow};
}

// Blocks above the stream, `beside` blocks from the floor of its valley.
Float slopeAbove(Pass& p, const Fields& f, Float canyon, Float beside, const Ice& ice) {
    const Float range = p.read(f.range), hilly = p.read(f.hilly);
    const Float varied = p.perlin2D("sides", 256, {.4f, 1.0f}) * 0.3f + 1.0f;  // not all valleys are alike
    const Float steep = (range * 0.85f + hilly * 0.17f + 0.015f) * varied;
    const Float side = beside * steep * (beside * 0.003f * range + 1.0f);
    // Table lands rise from their valleys to a level of their own.
    const Float table = p.read(f.table) * (1.0f - canyon) * (1.0f - range);
    Var<Float> rise = p.var(side + smoothstep(0.0f, 170.0f, beside) * table * 210.0f);
    // A trough: steep walls, shoulders above them. Side valleys hang above the floor of the main one.
    p.if_(ice.share > 0.0f, [&] {
        const Float wall = smoothstep(0.0f, 75.0f, beside) * (ice.main * 90.0f + 70.0f);
        const Float shoulder = max(beside - 60.0f, Float(0.0f));
        const Float trough = wall + shoulder * steep * (shoulder * 0.003f + 0.75f);
        const Float hanging = smoothstep(7.0f, 3.0f, ice.flow) * 36.0f;
        rise = lerp(static_cast<Float>(rise), trough + hanging, ice.share * 0.85f);
    });
    // Walls with terraces, then a flat top.
    p.if_(canyon > 0.0f, [&] {
        const Float wall = smoothstep(6.0f, 75.0f, beside + p.simplex2D("walls", 32, {.3f, 1.0f}) * 14.0f);
        const Float walls = landforms::terraces(wall * 190.0f, 31.0f, 4.0f) + beside * 0.02f;
        rise = lerp(static_cast<Float>(rise), walls, canyon);
    });
    return rise;
}

}  // namespace

namespace {

// −1…1: below 0 behind a range, where the west wind brings no rain: its line is to the west.
Float rainBesideRange(Pass& p, const Fields& f) {
    constexpr float kLength = 3000.0f;  // blocks in which the line changes by about 1
    const Float toEast = p.slope(f.rangeLine).x * kLength;
    return clamp(p.read(f.rangeLine) * toEast * -2.0f, -1.0f, 1.0f) * smoothstep(0.0f, 0.4f, p.read(f.range));
}

}  // namespace

void basePass(Pass& p, const Fields& f) {
    const Float moisture = p.read(f.rain) + rainBesideRange(p, f) * 0.3f;
    const Float canyon =
        p.read(f.table) * dryLand(p.read(f.temperature), moisture) * smoothstep(0.4f, 0.1f, p.read(f.range));
    p.set(f.moisture, moisture);
    p.set(f.canyon, canyon);
    constexpr float kFar = 250.0f, kFarthest = 380.0f;  // blocks from streams where these count less
    const Float land = p.read(f.land), range = p.read(f.range), hilly = p.read(f.hilly);
    const ValleySample v = p.valleys(f.rivers);
    const Ice ice = iceOf(p, f, v.flow);
    const Float floorWidth = sqrt(v.flow) * (1.0f - range * 0.6f) * 3.0f + ice.share * ice.main * 24.0f;
    const Float beside = max(v.distance - floorWidth, Float(0.0f));
    const Float slope = v.level + 1.6f + slopeAbove(p, f, canyon, beside, ice);
    // Where there are no streams; beyond the columns that see them, the mean height of land between them.
    Float plain = kSea + 2.0f + land * 30.0f;
    if (p.step() > kMaxValleyStep)
        plain = plain + range * (range * 480.0f + 170.0f) + hilly * 12.0f + p.read(f.table) * 150.0f;
    const Float inland = lerp(plain, slope, smoothstep(kFarthest, kFar, v.distance));
    Var<Float> ground = p.var(inland);
    p.if_(land < 0.25f, [&] {
        const Float cliffs = smoothstep(0.1f, 0.5f, p.perlin2D("cliffs", 128, {.3f, .6f, 1.0f}));
        const Float steep = range * 6000.0f + hilly * 900.0f + cliffs * 6000.0f + 420.0f;
        const Float coast = smoothMin(inland, kSea + 0.8f + land * steep, 3.0f);
        ground = lerp(coast, inland, smoothstep(0.15f, 0.25f, land));
    });
    p.if_(land <= 0.0f, [&] { ground = withStacks(p, f, seaFloor(p, land)); });
    // The sea fills troughs as far as their streams are low: fjords.
    const Float fjord = smoothstep(0.08f, -0.08f, p.read(f.temperature)) * smoothstep(0.02f, 0.15f, range) *
                        ice.main * smoothstep(75.0f, 30.0f, v.level);
    p.if_(fjord > 0.0f && land > -0.1f, [&] {
        const Float deep = smoothstep(34.0f, 4.0f, beside) * smoothstep(0.0f, 0.4f, fjord);
        ground = lerp(static_cast<Float>(ground), min(ground, Float(kSea - 42.0f)), deep);
    });
    const Volcano volcano = volcanoAt(p);
    p.if_(volcano.share > 0.0f, [&] { ground = smoothMax(ground, volcano.height, 12.0f); });
    p.set(f.craterLake, volcano.lake);
    p.set(f.isLava, volcano.isLava && volcano.lake > -kNoSpan);
    p.set(f.base, static_cast<Float>(ground));
    p.set(f.fromStream, v.distance);
    p.set(f.streamLevel, v.level);
    p.set(f.volcanic, volcano.share);
}

namespace {

struct Relief {
    Float height, rocky;
};

// Gullies, crags, dunes and towers.
Relief detailed(Pass& p, const Fields& f) {
    const Float land = p.read(f.land), range = p.read(f.range), base = p.read(f.base);
    const Float temperature = p.read(f.temperature), moisture = p.read(f.moisture);
    const Float inland = smoothstep(0.0f, 0.05f, land),
                beside = smoothstep(4.0f, 40.0f, p.read(f.fromStream));
    const Float flat = smoothstep(0.25f, 0.05f, range) * (1.0f - p.read(f.canyon));
    const Float dry = dryLand(temperature, moisture);
    const Vec2 slope = p.slope(f.base);
    Var<Float> height = p.var(base);
    Var<Float> rocky = p.var(p.read(f.canyon));
    const Float steep = length(slope);
    const Float strength = inland * smoothstep(kSea + 2.0f, kSea + 30.0f, base) * beside *
                           (max(max(range, dry), smoothstep(0.3f, 0.9f, steep)) * 0.6f + 0.4f) *
                           (1.0f - p.read(f.canyon) * 0.6f) * smoothstep(0.88f, 0.8f, p.read(f.volcanic));
    p.if_(strength > 0.0f, [&] {
        const Eroded gullies =
            erode(p, "gullies", slope, strength,
                  {.size = 128, .octaves = 5, .depth = 0.36f, .fullSlope = 0.9f, .gain = 0.6f});
        // On land they do not reach the sea's level.
        height = max(base + gullies.height, min(base, Float(kSea + 1.6f)));
    });
    const Float craggy =
        (range * 0.5f + 0.5f) * smoothstep(0.5f, 1.1f, steep) * (1.0f - p.read(f.canyon)) * inland;
    p.if_(craggy > 0.0f, [&] {
        const Float crags = abs(p.simplex2D("crags", 12, {.4f, .8f, 1.6f}));
        height = height + crags * craggy * 11.0f;
    });
    const Float sand =
        sandLand(temperature, moisture) * inland * flat * beside * smoothstep(0.3f, 0.1f, steep);
    p.if_(sand > 0.0f, [&] { height = height + landforms::dunes(p) * sand * 1.4f; });
    // Towers also stand in shallow water.
    const Float limestone = karstLand(temperature, moisture) * flat * smoothstep(-0.16f, -0.08f, land) *
                            smoothstep(0.25f, 0.1f, land) *
                            smoothstep(-0.05f, 0.2f, p.simplex2D("karst", 256, {.4f, 1.0f})) * beside;
    p.if_(limestone > 0.0f, [&] {
        const Float tower = landforms::towers(p) * limestone * 1.7f;
        height = height + tower;
        rocky = max(rocky, smoothstep(3.0f, 10.0f, tower));
    });
    const Float bumps = p.perlin2D("bumps", 8, {.25f, .5f, 1.0f, 1.4f});
    return {height + bumps * (inland * 0.6f + 0.25f) * max(beside, Float(0.3f)), rocky};
}

struct Water {
    Float height;  // of the ground
    Int water;     // z of the highest water where the ground is lower
    Float wet;     // 0…1: river, lake or their bank
};

constexpr float kFall = 9.0f, kSheet = 1.6f;  // blocks: height of a waterfall, thickness of its sheet

// Cuts beds and basins into ground of the given height.
Water cut(Pass& p, const Fields& f, Float ground) {
    const DrainageSample r = p.drainage(f.rivers);
    const Float land = p.read(f.land);
    const Float rough = p.perlin2D("banks", 8, {.5f, 1.0f});
    const Float fromBank = r.distance - r.halfWidth + rough * 0.4f;
    Var<Float> height = p.var(ground);
    Var<Int> water = p.var(Int(kSeaZ));
    Var<Float> wet = p.var(Float(0.0f));
    p.if_(r.distance < 64.0f && land > -0.02f, [&] {
        // To the coast the land, and the water with it, falls to the level of the sea.
        const Float even = min(r.level, max(p.read(f.base) - 1.0f, Float(kSea + 0.5f)));
        // Where it is steep it falls in steps. The sheet of a fall stands in the columns next below it.
        const Float steps = even * (1.0f / kFall), isSteep = smoothstep(0.07f, 0.12f, r.fall);
        const Float part = steps - floor(steps);
        const Float level = lerp(even, floor(steps) * kFall + 0.5f, isSteep);
        const Float top =
            select(isSteep > 0.5f && part > 1.0f - r.fall * (kSheet / kFall), level + kFall, level);
        const Float across = clamp(r.distance / max(r.halfWidth, Float(1.0f)), 0.0f, 1.0f);
        const Float bed = level - 0.6f - (1.0f - across * across) * (r.halfWidth * 0.3f + 0.8f);
        const Float bank = even + 1.3f + r.fall;  // above the water before a fall, too
        // Water above the sea needs banks; at the sea's level the ground may be lower beside it.
        const Float raised = max(ground, lerp(bank, ground, smoothstep(0.0f, 14.0f, fromBank)));
        const Float outside = lerp(ground, raised, clamp((level - kSea - 0.5f) * 2.0f, 0.0f, 1.0f));
        height = select(fromBank < 0.0f, min(bed, ground), outside);
        water = select(fromBank < 0.0f, max(Int(floor(top)), Int(kSeaZ)), Int(kSeaZ));
        wet = smoothstep(12.0f, 2.0f, fromBank);
    });
    // Pools of marshes, as high as the river beside them, with rims.
    const Float marsh = smoothstep(0.0f, 0.12f, p.read(f.moisture)) * smoothstep(0.02f, 0.006f, r.fall) *
                        smoothstep(44.0f, 26.0f, fromBank) * smoothstep(3.0f, 7.0f, fromBank);
    p.if_(marsh > 0.0f && land > 0.02f && ground < r.level + 2.6f, [&] {
        const Float pools = p.simplex2D("marsh pools", 10, {.5f, 1.0f}) - (1.0f - marsh) * 1.5f;
        const Float level = max(min(r.level, p.read(f.base) - 1.0f), Float(kSea + 0.5f));
        const Bool isPool = pools > 0.32f, isRim = pools > 0.05f;
        const Float rim = max(static_cast<Float>(height), floor(level) + 1.2f);
        height = select(isPool, floor(level) - 0.7f, select(isRim, rim, static_cast<Float>(height)));
        water = select(isPool, Int(floor(level)), static_cast<Int>(water));
        wet = select(isRim, Float(1.0f), static_cast<Float>(wet));
    });
    p.if_(r.lakeDistance < 60.0f, [&] {
        const Float fromShore = r.lakeDistance + p.simplex2D("shores", 24, {.3f, .6f, 1.0f}) * 22.0f;
        const Float shore = r.lakeLevel + 1.2f + clamp(fromShore * 0.1f, 0.0f, 2.0f);
        const Float now = height;
        const Float outside = lerp(shore, max(now, shore), smoothstep(0.0f, 30.0f, fromShore));
        const Float bed = r.lakeLevel - 0.8f - min(fromShore * -0.35f, Float(30.0f));
        height = select(fromShore < 0.0f, bed, select(fromShore < 40.0f, outside, now));
        water = select(fromShore < 0.0f, max(Int(floor(r.lakeLevel)), Int(kSeaZ)), static_cast<Int>(water));
        wet = max(static_cast<Float>(wet), smoothstep(10.0f, 2.0f, fromShore));
    });
    return {height, water, wet};
}

}  // namespace

void reliefPass(Pass& p, const Fields& f) {
    const Relief r = detailed(p, f);
    const Water w = cut(p, f, withPlaces(p, f, r.height));
    Var<Float> height = p.var(w.height), spring = p.var(Float(0.0f));
    Var<Int> water = p.var(w.water);
    addSprings(p, f, height, water, spring);
    const Bool isInCrater = height < Float(p.read(f.craterLake));
    p.set(f.height, static_cast<Float>(height));
    p.set(f.rocky, r.rocky);
    p.set(f.water, select(isInCrater, p.read(f.craterLake), static_cast<Int>(water)));
    p.set(f.wet, select(isInCrater, Float(1.0f), w.wet));
    p.set(f.spring, static_cast<Float>(spring));
    p.set(f.surface, Int(floor(height)));
}

}  // namespace terrane::gen::wilderness
