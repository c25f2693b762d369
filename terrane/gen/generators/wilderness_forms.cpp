#include <numbers>

#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/generators/wilderness.h"

// The large forms of wilderness: land and sea, ranges, table lands, volcanoes, climate.

namespace terrane::gen::wilderness {

namespace {

// Blocks from one warm belt to the next, along y. Where belts lie, how wide they are and whether warm land is
// to the north or to the south follows from the seed.
constexpr int kClimatePeriods[] = {24576, 32768, 40960};

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
        p.simplex2D("continents", 64, {.006f, .012f, .026f, .06f, .115f, .19f, .26f, .53f, 1.0f});
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

// −1…1: how warm the belt is, whose borders bend by some km. Near block 0, 0 it is temperate for all seeds.
Float beltAt(Pass& p) {
    constexpr float kNearTemperate = 0.05f;  // of a turn, to either side
    const auto chance = [&](const char* name) { return p.random2D(name, Int(0), Int(0)); };
    const auto turnsOf = [&](int period) {
        return Float(floorModulo(p.y(), period)) * (1.0f / static_cast<float>(period));
    };
    const Float width = chance("width of belts");
    const Float turns = multiSelect(
        {{width < 0.33f, turnsOf(kClimatePeriods[0])}, {width < 0.67f, turnsOf(kClimatePeriods[1])}},
        turnsOf(kClimatePeriods[2]));
    const Float north = select(chance("side of warm land") < 0.5f, Float(0.0f), Float(0.5f));
    const Float phase = north + (chance("phase of belts") - 0.5f) * (2.0f * kNearTemperate);
    const Float bends = p.perlin2D("bends of belts", 8192, {1.0f}) * 0.16f;
    return sin((turns + phase + bends) * (2.0f * std::numbers::pi_v<float>));
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
    const Float temperature =
        beltAt(p) * 0.58f + p.perlin2D("temperature", 512, {.08f, .15f, .22f, .5f}) * 0.7f;
    const Float nearSea = smoothstep(0.5f, 0.0f, land);
    const Float moisture =
        p.perlin2D("moisture", 128, {.05f, .08f, .13f, .3f, .6f, 1.0f}) * 1.05f + nearSea * 0.12f;
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
