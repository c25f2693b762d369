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

// Blocks from the foot of a table land to its level.
constexpr float kTableRise = 210.0f, kTableEdge = 170.0f;

// Share of the table lands that rise to a level of their own.
Float tableShare(Pass& p, const Fields& f, Float canyon) {
    return p.read(f.table) * (1.0f - canyon) * (1.0f - p.read(f.range));
}

struct Side {
    Float rise;   // blocks above the stream
    Float steep;  // blocks a block that it rises, but where a divide cuts it off
};

// The side of a valley, `straight` blocks from its floor.
Side sideOf(Pass& p, const Fields& f, Float canyon, Float straight, const Ice& ice) {
    const Float range = p.read(f.range), hilly = p.read(f.hilly);
    // Spurs and hollows: no side is even, and no ridge as long as its stream.
    const Float spurs = p.perlin2D("spurs", 64, {.25f, .5f, 1.0f});
    const Float beside = straight * (spurs * 0.34f + 1.0f);
    const Float varied = p.perlin2D("sides", 256, {.4f, 1.0f}) * 0.3f + 1.0f;  // not all valleys are alike
    const Float steep = (range * 0.85f + hilly * 0.17f + 0.015f) * varied;
    const Float side = beside * steep * (beside * 0.003f * range + 1.0f);
    // The foot of a table land is a hollow in some places, a cliff in others.
    const Float part = clamp(beside * ((varied - 0.1f) * (1.0f / kTableEdge)), 0.0f, 1.0f);
    const Float cliff = smoothstep(0.85f, 1.15f, varied);
    const Float edge = part * lerp(part * (3.0f - part * 2.0f), 2.0f - part, cliff);
    const Float edgeSteep = (1.0f - part) * lerp(part * 6.0f, Float(2.0f), cliff);
    const Float table = tableShare(p, f, canyon) * kTableRise;
    Var<Float> rise = p.var(side + edge * table);
    const Float sides = steep + edgeSteep * table * (1.0f / kTableEdge);
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
    return {rise, min(sides, Float(1.1f)) * (1.0f - canyon)};
}

// Alluvial fans: where a dry stream leaves a range, the gravel that it carried lies in a cone with the stream
// on top, narrow between the last spurs and wide on the plain.
struct Fan {
    Float rise;   // blocks above the stream
    Float share;  // 0…1: gravel
};

Fan fanOf(const ValleySample& v, Float range) {
    constexpr float kHighest = 34.0f, kNarrow = 26.0f, kWide = 190.0f;  // blocks
    constexpr float kWet = 8.0f, kDry = 5.5f;                           // flow: rivers keep their valleys
    const Float up = smoothstep(0.01f, 0.24f, range);                   // from the toe to the apex
    const Float width = lerp(Float(kWide), Float(kNarrow), up);
    const Float across = clamp(v.distance / width, 0.0f, 1.0f);
    const Float share = smoothstep(kWet, kDry, v.flow) * smoothstep(0.55f, 0.3f, range);
    return {up * (1.0f - across * across) * share * kHighest,
            smoothstep(0.0f, 0.15f, up) * smoothstep(1.0f, 0.7f, across) * share};
}

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
    const Side side = sideOf(p, f, canyon, beside, ice);
    const Fan fan = fanOf(v, range);
    const Float slope = v.level + 1.6f + smoothMax(side.rise, fan.rise, 4.0f);
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
                        ice.main * smoothstep(32.0f, 16.0f, v.level);
    p.if_(fjord > 0.0f && land > -0.1f, [&] {
        const Float deep = smoothstep(34.0f, 4.0f, beside) * smoothstep(0.0f, 0.4f, fjord);
        ground = lerp(static_cast<Float>(ground), min(ground, Float(kSea - 42.0f)), deep);
    });
    const Volcano volcano = volcanoAt(p);
    p.if_(volcano.share > 0.0f,
          [&] { ground = smoothMax(ground, volcano.height + flanksOf(p, volcano), 12.0f); });
    p.set(f.craterLake, volcano.lake);
    p.set(f.isLava, volcano.isLava && volcano.lake > -kNoSpan);
    p.set(f.base, static_cast<Float>(ground));
    p.set(f.fan, fan.share * smoothstep(0.05f, 0.1f, land));
    p.set(f.fromStream, v.distance);
    p.set(f.streamLevel, v.level);
    p.set(f.sides, side.steep * smoothstep(kFarthest, kFar, v.distance));
    p.set(f.volcanic, volcano.share);
}

namespace {

struct Relief {
    Float height, rocky;
};

// Blocks of limestone above the plain: large towers and small ones, each of its own size, in groups and
// alone, some of which have grown together.
Float karstTowers(Pass& p) {
    constexpr int kWide = 118, kNarrow = 61;
    const Float rough = p.simplex2D("tower sides", 16, {.35f, .7f, 1.0f}) * 5.0f;
    const auto towers = [&](const char* name, const char* sizes, int cell, float least, float more) {
        const Voronoi2D at = p.voronoi2D(name, cell, 1);
        const Float chance = p.random2D(sizes, p.x() + at.offset.x, p.y() + at.offset.y);
        // A quarter of the cells is empty.
        const Float radius =
            (max(chance - 0.25f, Float(0.0f)) * more + least) * smoothstep(0.22f, 0.27f, chance);
        const Float near = clamp(1.0f - (at.distance + rough) / max(radius, Float(1.0f)), 0.0f, 1.0f);
        const Float tower = smoothstep(0.0f, 0.35f, near) * 0.7f + near * 0.3f;
        const float left = shareLeft(cell, p.step());
        return lerp(Float(0.2f), tower, left) * radius * (chance * 0.9f + 1.6f);
    };
    return max(towers("large towers", "large tower sizes", kWide, 24.0f, 30.0f),
               towers("small towers", "small tower sizes", kNarrow, 9.0f, 17.0f));
}

// The slope by which gullies are cut. Where a divide is flat across, between steep sides, gullies cross it as
// they come: else it would stand above both sides like a dyke.
Vec2 withCrests(Pass& p, const Fields& f, Vec2 slope, Float steep, Float beside) {
    const Float sides = p.read(f.sides);
    const Float lack = smoothstep(0.55f, 0.15f, steep / max(sides, Float(0.01f))) * sides * beside;
    Var<Float> x = p.var(slope.x), y = p.var(slope.y);
    p.if_(lack > 0.0f, [&] {
        constexpr int kSize = 64;
        const float left = shareLeft(kSize, p.step());  // wide columns get the mean
        const auto across = [&](const char* name) {
            return lerp(Float(0.5f), p.perlin2D(name, kSize, {.4f, 1.0f}) * 1.1f, left) * lack;
        };
        x = slope.x + across("crests x");
        y = slope.y + across("crests y");
    });
    return {x, y};
}

// Gullies, crags, dunes and towers.
Relief detailed(Pass& p, const Fields& f) {
    const Float land = p.read(f.land), range = p.read(f.range), base = p.read(f.base);
    const Float temperature = p.read(f.temperature), moisture = p.read(f.moisture);
    const Float volcanic = p.read(f.volcanic);
    // Volcanoes are land, wherever they stand.
    const Float inland = max(smoothstep(0.0f, 0.05f, land), smoothstep(0.05f, 0.15f, volcanic)),
                floors = p.perlin2D("valley floors", 48, {.5f, 1.0f}) * 0.45f + 1.0f,
                beside = smoothstep(4.0f, 40.0f, p.read(f.fromStream) * floors);
    const Float flat = smoothstep(0.25f, 0.05f, range) * (1.0f - p.read(f.canyon));
    const Float dry = dryLand(temperature, moisture);
    const Vec2 slope = p.slope(f.base);
    Var<Float> height = p.var(base);
    Var<Float> rocky = p.var(p.read(f.canyon));
    const Float steep = length(slope);
    const Vec2 fall = withCrests(p, f, slope, steep, beside);
    const Float strength = inland * smoothstep(kSea + 2.0f, kSea + 30.0f, base) * beside *
                           (max(max(range, dry), smoothstep(0.3f, 0.9f, steep)) * 0.6f + 0.4f) *
                           (1.0f - p.read(f.canyon) * 0.6f) * smoothstep(0.9f, 0.55f, volcanic);
    p.if_(volcanic > 0.12f, [&] { height = height + barrancos(p, f, slope); });
    p.if_(strength > 0.0f, [&] {
        const Eroded gullies =
            erode(p, "gullies", fall, strength,
                  {.size = 128, .octaves = 5, .depth = 0.37f, .fullSlope = 0.9f, .gain = 0.6f});
        // They do not reach the level of the sea, nor that of the streams that they lead to: they are
        // shallower where there is less room.
        const Float lowest = max(p.read(f.streamLevel) + 1.0f, Float(kSea + 1.6f));
        const Float room = max(height - lowest, Float(0.01f));
        const Float share = gullies.height / room;
        height = height + gullies.height / sqrt(share * share + 1.0f);
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
        const Float tower = karstTowers(p) * limestone;
        height = height + tower;
        rocky = max(rocky, smoothstep(3.0f, 10.0f, tower));
    });
    const Float bumps = p.perlin2D("bumps", 8, {.25f, .5f, 1.0f, 1.4f});
    const Float rough = height + bumps * (inland * 0.6f + 0.25f) * max(beside, Float(0.3f));
    // The rarest peaks stay below the top of the world.
    constexpr float kHigh = 1600.0f;
    return {rough - max(rough - kHigh, Float(0.0f)) * 0.5f, rocky};
}

struct Water {
    Float height;  // of the ground
    Int water;     // z of the highest water where the ground is lower
    Float wet;     // 0…1: river, lake or their bank
    Int fall;      // see Fields::fall
};

// Where streams are steep they come down in steps: level pools, with a fall from each to the next.
constexpr float kFall = 9.0f, kHighFall = 27.0f;  // blocks: height of waterfalls; of those of steep streams
constexpr float kSheet = 1.6f;                    // blocks: thickness of the sheet of falling water
constexpr float kFoam = 4.5f;                     // blocks before it that are white

struct Steps {
    Float share;  // 0…1: steps rather than an even fall
    Float fall;   // blocks from a pool to the next
    Float part;   // 0…1: from the lower end of a pool to the fall above it
    Float level;  // z of the water
    Bool isSheet;
};

// `even`: z of the water if it fell evenly; `gradient`: how steep that is.
Steps stepsOf(Float even, Float gradient) {
    const Float share = smoothstep(0.07f, 0.12f, gradient);
    const Float fall = select(gradient > 0.2f, Float(kHighFall), Float(kFall));
    const Float steps = even / fall, whole = floor(steps), part = steps - whole;
    return {share, fall, part, lerp(even, whole * fall + 0.5f, share),
            share > 0.5f && part > 1.0f - gradient * kSheet / fall};
}

// Share: an arm of a river that splits. Arms part from the river `fromFork` blocks inland of here, at angles
// of these slopes to either side, and wind; the river goes on between them.
Float armOf(Pass& p, const DrainageSample& r, Float fromFork) {
    constexpr float kSlopes[] = {0.25f, 0.6f, 1.15f};
    constexpr float kHalfWidth = 4.5f;  // blocks
    const Float winding = p.perlin2D("arms of deltas", 36, {.16f, .3f}) * fromFork;
    Float near = r.distance - r.halfWidth * 0.7f + kHalfWidth;
    for (const float slope : kSlopes) near = min(near, abs(r.distance + winding - fromFork * slope));
    return smoothstep(kHalfWidth, kHalfWidth - 2.5f, near);
}

// Where a large river meets the sea it leaves a delta: a fan of silt on both sides of the shore, which its
// arms part, at the level of the sea.
Float withDelta(Pass& p, const Fields& f, const DrainageSample& r, Float ground) {
    constexpr float kFork = 0.075f, kShore = 2600.0f;  // land where arms part; blocks by land near the shore
    const Float land = p.read(f.land);
    const Float fromFork = (kFork - land) * kShore;
    const Float delta = smoothstep(16.0f, 34.0f, r.flow) * smoothstep(9.0f, 4.0f, r.level) *
                        smoothstep(250.0f, 100.0f, r.distance) *
                        smoothstep(1.5f, 0.9f, r.distance / max(fromFork, Float(20.0f))) *
                        smoothstep(kFork, 0.03f, abs(land)) * smoothstep(0.25f, 0.1f, p.read(f.range));
    Var<Float> height = p.var(ground);
    p.if_(delta > 0.0f, [&] {
        const Float flats = p.perlin2D("flats of deltas", 24, {.5f, 1.0f});
        const Float silt = clamp(ground, kSea - 2.2f + delta * 3.4f, Float(kSea + 1.5f)) + flats * 0.7f;
        const Float arms = armOf(p, r, fromFork) * smoothstep(0.0f, 0.2f, delta);
        height = lerp(ground, lerp(silt, Float(kSea - 2.4f), arms), smoothstep(0.0f, 0.3f, delta));
    });
    return height;
}

// Cuts beds and basins into ground of the given height.
Water cut(Pass& p, const Fields& f, Float uncut) {
    const DrainageSample r = p.drainage(f.rivers);
    const Float land = p.read(f.land);
    const Float ground = withDelta(p, f, r, uncut);
    Var<Float> height = p.var(ground);
    Var<Int> water = p.var(Int(kSeaZ));
    Var<Float> wet = p.var(Float(0.0f));
    Var<Int> fall = p.var(Int(0));
    p.if_(r.distance < 72.0f && land > -0.02f, [&] {
        // To the coast the land, and the water with it, falls to the level of the sea.
        const Float even = min(r.level, max(p.read(f.base) - 1.0f, Float(kSea + 0.5f)));
        // Narrow here and wide there, with bays and points. A core stays open.
        const Float rough = p.perlin2D("banks", 8, {.5f, 1.0f});
        const Float bays = p.perlin2D("bays of rivers", 20, {.35f, .7f, 1.0f});
        const Float channel =
            min(r.distance - r.halfWidth + rough * 0.4f + bays * (r.halfWidth * 0.28f + 0.8f),
                r.distance - 1.8f + rough * 0.5f);
        const Steps s = stepsOf(even, r.fall);
        const Float before =
            (1.0f - s.part) * s.fall / max(r.fall, Float(0.01f));       // blocks to the fall above
        const Float below = smoothstep(0.4f, 0.95f, s.part) * s.share;  // share: at the foot of a fall
        // The pool that it dug, round at the fall.
        const Float fromBank = channel - below * smoothstep(0.0f, 9.0f, before) * (s.fall * 0.2f + 0.8f);
        const Float across = clamp(r.distance / max(r.halfWidth, Float(1.0f)), 0.0f, 1.0f);
        const Float bed = s.level - 0.6f - (1.0f - across * across) * (r.halfWidth * 0.3f + 0.8f) -
                          below * (s.fall * 0.16f + 1.0f);
        // Banks slope down to the pools, with rock on both sides of a fall, which holds the water before it.
        const Float beside = smoothstep(0.75f, 0.96f, s.part), holds = smoothstep(4.5f, 2.5f, before);
        const Float away = max(fromBank, Float(0.0f));
        // It climbs from the pool in crags.
        const Float rock = beside * (s.fall + rough * 2.0f + 5.0f),
                    crags = min(rock, away * (rough * 1.5f + 3.5f) + 1.0f);
        const Float slope = s.level + 0.8f + away * (rough * 0.4f + 0.7f) + lerp(crags, rock, holds);
        const Float lowered = lerp(ground, min(ground, slope), s.share * smoothstep(70.0f, 40.0f, away));
        const Float bank = lerp(s.level + 0.8f, even + 0.9f + r.fall, lerp(Float(1.0f), holds, s.share));
        // Water above the sea needs banks; at the sea's level the ground may be lower beside it.
        const Float raised = max(lowered, lerp(bank, lowered, smoothstep(0.0f, 14.0f, away)));
        const Float outside = lerp(ground, raised, clamp((s.level - kSea - 0.5f) * 2.0f, 0.0f, 1.0f));
        const Bool isSheet = s.isSheet && channel < 0.0f;
        const Float top = select(isSheet, s.level + s.fall, s.level);
        const Bool isOpen = fromBank < 0.0f;
        height = select(isOpen, min(bed, ground), outside);
        water = select(isOpen, max(Int(floor(top)), Int(kSeaZ)), Int(kSeaZ));
        wet = smoothstep(12.0f, 2.0f, fromBank);
        const Float foam = rough * 2.0f + (kSheet + kFoam);
        const Bool isFoam = s.share > 0.5f && isOpen && s.part > 1.0f - r.fall * foam / s.fall;
        fall = select(isSheet, Int(floor(top)) - Int(floor(s.level)), select(isFoam, Int(kFoamMark), Int(0)));
    });
    // Pools of marshes, as high as the river beside them, with rims.
    const Float fromBank = r.distance - r.halfWidth;
    const Float marsh = smoothstep(0.0f, 0.12f, p.read(f.moisture)) * smoothstep(0.02f, 0.006f, r.fall) *
                        smoothstep(44.0f, 26.0f, fromBank) * smoothstep(4.0f, 8.0f, fromBank);
    p.if_(marsh > 0.0f && land > 0.02f && ground < r.level + 2.6f, [&] {
        const Float pools = p.simplex2D("marsh pools", 10, {.5f, 1.0f}) - (1.0f - marsh) * 1.5f;
        const Float level = max(min(r.level, p.read(f.base) - 1.0f), Float(kSea + 0.5f));
        const Bool isPool = pools > 0.32f, isRim = pools > 0.05f;
        const Float rim = max(static_cast<Float>(height), floor(level) + 1.2f);
        height = select(isPool, floor(level) - 0.7f, select(isRim, rim, static_cast<Float>(height)));
        water = select(isPool, Int(floor(level)), static_cast<Int>(water));
        wet = select(isRim, Float(1.0f), static_cast<Float>(wet));
    });
    p.if_(r.lakeDistance < 110.0f, [&] {
        const Float fromShore = r.lakeDistance + p.simplex2D("shores", 24, {.2f, .4f, .7f, 1.0f}) * 22.0f +
                                p.perlin2D("arms of lakes", 140, {1.0f, .8f}) * 42.0f;
        const Float shore = r.lakeLevel + 1.2f + clamp(fromShore * 0.1f, 0.0f, 2.0f);
        const Float now = height;
        // Rivers keep their banks up to the shore. Where the land is lower, what holds the lake slopes down.
        const Float asBefore = max(smoothstep(0.0f, 30.0f, fromShore), static_cast<Float>(wet));
        const Float held = lerp(max(now, shore), now, smoothstep(20.0f, 56.0f, fromShore));
        const Float outside = lerp(shore, held, asBefore);
        const Float bed = r.lakeLevel - 0.8f - min(fromShore * -0.35f, Float(30.0f));
        height = select(fromShore < 0.0f, bed, outside);
        water = select(fromShore < 0.0f, max(Int(floor(r.lakeLevel)), Int(kSeaZ)), static_cast<Int>(water));
        wet = max(static_cast<Float>(wet), smoothstep(10.0f, 2.0f, fromShore));
        fall = select(fromShore < 0.0f, Int(0), static_cast<Int>(fall));
    });
    return {height, water, wet, fall};
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
    p.set(f.fall, w.fall);
    p.set(f.wet, select(isInCrater, Float(1.0f), w.wet));
    p.set(f.spring, static_cast<Float>(spring));
}

}  // namespace terrane::gen::wilderness
