#include <numbers>

#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/generators/wilderness.h"

// The large forms of wilderness: land and sea, ranges, table lands, volcanoes, climate.

namespace terrane::gen::wilderness {

namespace {

constexpr int kClimatePeriod = 32768;  // blocks from one warm belt to the next, along y

constexpr int kOriginRadius = 2400;  // blocks

// Raises the land value around block 0, 0, where new worlds begin.
Float originLand(Pass& p) {
    constexpr float kRaise = 0.5f;
    return smoothstep(1.0f, 0.0f, landforms::fromOrigin(p, kOriginRadius)) * kRaise;
}

// 0…1: the land there is low, so that one sees far.
Float beyondOrigin(Pass& p) {
    return smoothstep(0.06f, 0.4f, landforms::fromOrigin(p, kOriginRadius));
}

Float landAt(Pass& p) {
    constexpr float kSeaShare = 0.2f;  // makes 35…45 % land
    const Float noise =
        p.simplex2D("continents", 64, {.005f, .009f, .017f, .03f, .06f, .11f, .22f, .55f, 1.0f});
    return noise + originLand(p) - kSeaShare;
}

// Ranges lie on both sides of the lines where a slow noise is 0, and are as long as these.
Float rangeLine(Pass& p) {
    return p.simplex2D("ranges", 1024, {.05f, .12f, .25f, .6f, 1.0f});
}

Float rangeAt(Pass& p, Float land) {
    const Float where = smoothstep(-0.55f, -0.1f, p.perlin2D("range places", 2048, {.3f, .6f, 1.0f}));
    return smoothstep(0.5f, 0.08f, abs(rangeLine(p))) * where * smoothstep(0.0f, 0.16f, land) *
           beyondOrigin(p);
}

Float tableAt(Pass& p, Float land) {
    const Float where = p.perlin2D("table lands", 512, {.06f, .15f, .4f, 1.0f});
    return smoothstep(0.1f, 0.22f, where) * smoothstep(0.05f, 0.3f, land) * beyondOrigin(p);
}

Float hillyAt(Pass& p) {
    return smoothstep(0.0f, 0.7f, p.perlin2D("hilly", 2048, {.2f, .4f, 1.0f}));
}

Float peaksAt(Pass& p) {
    return p.simplex2D("peaks", 512, {.3f, .6f, 1.0f});
}

// Large rivers fall gently, as far as the land lets them: nearly all of its height is that of streams above
// them and of slopes.

// Blocks above the sea, from the coast inland.
Float plainHeight(Float land) {
    return smoothstep(0.0f, 0.9f, land) * 25.0f + smoothstep(0.0f, 0.06f, land) * 4.0f + land * 80.0f;
}

Float coarseHeight(Pass& p) {
    const Float land = landAt(p), range = rangeAt(p, land), table = tableAt(p, land);
    const Float inland = smoothstep(0.0f, 0.1f, land);
    const Float courses = p.simplex2D("courses", 256, {.25f, .5f, 1.0f});
    const Float bulge = range * (peaksAt(p) * 100.0f + 360.0f);
    return kSea + 1.0f + plainHeight(land) * 0.09f + max(bulge, table * 70.0f) +
           courses * inland * (range * 20.0f + hillyAt(p) * 2.0f + 0.8f) + volcanoAt(p).rise * 0.12f;
}

Float streamGradient(Pass& p) {
    const Float range = rangeAt(p, landAt(p));
    const Float strong = peaksAt(p) * 0.4f + 1.25f;
    return hillyAt(p) * 0.05f + range * strong + volcanoAt(p).share * 0.3f + 0.008f;
}

}  // namespace

// A cone with a crater around the point of a wide cell.
Volcano volcanoAt(Pass& p) {
    constexpr int kCell = 6144;
    constexpr float kChance = 0.3f;
    const Voronoi2D cell = p.voronoi2D("volcanoes", kCell, 1);
    const Int x = p.x() + cell.offset.x, y = p.y() + cell.offset.y;
    const Bool isVolcano = p.random2D("is volcano", x, y) < kChance;
    const Float size = p.random2D("volcano size", x, y);
    const Float radius = size * 500.0f + 900.0f, rise = size * 450.0f + 600.0f, crater = size * 60.0f + 90.0f;
    const Float away = cell.distance / radius;
    // Of ten craters four have a lake and three are full of lava.
    const Float inCrater = p.random2D("in the crater", x, y);
    constexpr float kFoot = 45.0f;  // blocks below the sea
    Var<Float> height = p.var(Float(0.0f)), share = p.var(Float(0.0f));
    Var<Int> lake = p.var(Int(-kNoSpan));
    p.if_(isVolcano && away < 1.3f, [&] {
        // Flows of lava make its foot uneven, not its crater.
        const Float uneven = p.simplex2D("lava flows", 128, {.2f, .5f, 1.0f}) * 0.22f + 1.0f;
        const Float along = away * lerp(Float(1.0f), uneven, smoothstep(0.15f, 0.5f, away));
        const Float outside = clamp(1.0f - along, 0.0f, 1.0f);
        // A cone whose sides get steeper up to the rim.
        const Float rim = clamp(1.0f - crater / radius, 0.0f, 1.0f), up = min(outside, rim);
        const Float inside = smoothstep(crater * 0.95f, crater * 0.55f, cell.distance);
        height = up * (up * 0.75f + 0.25f) * rise - inside * rise * 0.12f;
        share = outside;
        const Float level = kSea - kFoot + rim * (rim * 0.75f + 0.25f) * rise - rise * 0.06f;
        lake = select(inCrater < 0.7f && cell.distance < crater, Int(level), static_cast<Int>(lake));
    });
    return {kSea - kFoot + height, height, share, lake, inCrater < 0.3f};
}

Float dryLand(Float temperature, Float moisture) {
    return smoothstep(0.12f, 0.24f, temperature) * smoothstep(0.0f, -0.12f, moisture) *
           smoothstep(-0.62f, -0.5f, moisture);
}

Float sandLand(Float temperature, Float moisture) {
    return smoothstep(0.16f, 0.28f, temperature) * smoothstep(-0.42f, -0.55f, moisture);
}

Float karstLand(Float temperature, Float moisture) {
    return smoothstep(0.1f, 0.25f, temperature) * smoothstep(0.1f, 0.25f, moisture);
}

Drainage rivers(GeneratorBuilder& g) {
    return g.drainage("rivers",
                      {.spacing = 256,
                       .seaLevel = kSea + 0.5f,
                       .minFlow = 8,
                       .halfWidth = 2.0f,
                       .maxHalfWidth = 20.0f,
                       .reach = 256.0f,
                       .lakeDepth = 2.1f,
                       .lakeNodes = 3},
                      coarseHeight, streamGradient);
}

void formsPass(Pass& p, const Fields& f) {
    const Float land = landAt(p), range = rangeAt(p, land);
    const Int inBelt = floorModulo(p.y(), kClimatePeriod);
    const Float belt = sin(Float(inBelt) * (2.0f * std::numbers::pi_v<float> / kClimatePeriod));
    const Float temperature = belt * 0.58f + p.perlin2D("temperature", 512, {.05f, .1f, .2f, .5f}) * 0.7f;
    const Float nearSea = smoothstep(0.5f, 0.0f, land);
    const Float moisture =
        p.perlin2D("moisture", 256, {.06f, .12f, .3f, .6f, 1.0f}) * 1.05f + nearSea * 0.12f;
    // The sea follows every bay and rock of the shore.
    p.set(f.land, land + p.simplex2D("shore line", 8, {.001f, .002f, .003f}));
    p.set(f.range, range);
    p.set(f.hilly, hillyAt(p));
    p.set(f.table, tableAt(p, land));
    p.set(f.rangeLine, rangeLine(p));
    p.set(f.temperature, temperature);
    p.set(f.rain, moisture);
    setPlace(p, f);
}

}  // namespace terrane::gen::wilderness
