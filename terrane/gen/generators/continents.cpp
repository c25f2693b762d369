#include "terrane/gen/generators/continents.h"

#include <numbers>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/gen/generators/landforms.h"

namespace terrane::gen {

// Continents: ranges with spurs and gullies, plains, table lands and canyons, dunes, karst, volcanoes, rivers
// from range to sea, and sixteen biomes in belts of climate.

namespace continents {

const char* biomeName(Biome biome) {
    constexpr const char* kNames[] = {
        "ocean",  "reef", "beach",   "meadow", "oak forest",  "birch forest", "old forest", "taiga",
        "tundra", "snow", "savanna", "desert", "canyon land", "swamp",        "alpine",     "rain forest"};
    static_assert(std::size(kNames) == static_cast<std::size_t>(Biome::Count));
    return kNames[static_cast<std::size_t>(biome)];
}

}  // namespace continents

void writeContinents(GeneratorBuilder& g) {
    const continents::Fields f(g);
    g.pass2D("shape", [&](Pass& p) { shapePass(p, f); });
    g.pass2D("color", [&](Pass& p) { colorPass(p, f); });
    g.tint(f.color);
    g.pass2D("relief", [&](Pass& p) { reliefPass(p, f); });
    g.pass2D("surface", [&](Pass& p) { surfacePass(p, f); });
    g.pass2D("plants", [&](Pass& p) { plantsPass(p, f); });
    g.pass3D("land", [&](Pass& p) { landPass(p, f); });
    if (g.step() == 1) g.pass3D("cave life", [&](Pass& p) { caveLifePass(p, f); });
}

}  // namespace terrane::gen

namespace terrane::gen::continents {

// The large forms of continents: land and sea, climate, ranges, hills, volcanoes.

namespace {

// Raises the land value around block 0, 0, where new worlds begin: by kRaise there, by 0 from kRadius blocks
// on.
Float originLand(Pass& p) {
    constexpr int kRadius = 1800;
    constexpr float kRaise = 0.5f;
    return smoothstep(1.0f, 0.0f, landforms::fromOrigin(p, kRadius)) * kRaise;
}

Float landNoise(Pass& p) {
    constexpr float kSeaShare = 0.2f;  // makes 30…45 % land
    const Float continents =
        p.simplex2D("continents", 64, {.012f, .02f, .035f, .07f, .11f, .22f, .55f, 1.0f});
    return continents + originLand(p) - kSeaShare;
}

// Belts along y: temperate at 0, hot at +8,192, cold at -8,192.
Float temperatureAt(Pass& p) {
    const Int inBelt = floorModulo(p.y(), kClimatePeriod);
    const Float belt = sin(Float(inBelt) * (2.0f * std::numbers::pi_v<float> / kClimatePeriod));
    return belt * 0.72f + p.simplex2D("temperature", 512, {.05f, .1f, .2f, .5f}) * 0.55f;
}

Float moistureAt(Pass& p, Float land) {
    const Float nearSea = smoothstep(0.5f, 0.0f, land);
    return p.simplex2D("moisture", 256, {.06f, .12f, .3f, .6f, 1.0f}) * 1.05f + nearSea * 0.12f;
}

// Ranges lie on both sides of the lines where a slow noise is 0.
Float rangesAt(Pass& p, Float land) {
    const Float line = p.simplex2D("ranges", 768, {.12f, .25f, .5f, 1.0f});
    const Float where = smoothstep(-0.25f, 0.25f, p.simplex2D("range places", 2048, {.5f, 1.0f}));
    const Float crest = smoothstep(0.5f, 0.06f, abs(line));
    return crest * where * smoothstep(0.0f, 0.16f, land);
}

// Blocks above the plain. Peaks and passes along a range.
Float rangeHeight(Pass& p, Float mountains) {
    constexpr float kRound = 0.07f;  // crests are round over some 20 blocks: on a crease no way is downhill
    const Float noise = p.simplex2D("peaks", 256, {.25f, .6f, 1.0f});
    const Float peaks = 1.0f + kRound - sqrt(noise * noise + kRound * kRound);
    return mountains * (30.0f + peaks * peaks * 108.0f);
}

// Blocks; below 0 under water. A shelf of 12 to 16 blocks goes over into the deep sea.
Float plainHeight(Float land) {
    const Float inland = smoothstep(0.0f, 0.7f, land) * 14.0f + smoothstep(0.0f, 0.06f, land) * 3.0f;
    const Float shelf = smoothstep(0.0f, -0.09f, land) * -13.0f;
    const Float deep = smoothstep(-0.1f, -0.45f, land) * -42.0f;
    return inland + shelf + deep;
}

// A cone with a crater around the point of a wide cell, if it is a volcano. Adds to the ground, also on the
// sea floor.
struct Volcano {
    Float rise;   // blocks
    Float share;  // 0…1: from its foot to its middle
};
Volcano volcanoAt(Pass& p) {
    constexpr int kCell = 3072;
    constexpr float kRadius = 420.0f, kRise = 132.0f, kCrater = 52.0f, kChance = 0.4f;
    const Voronoi2D cell = p.voronoi2D("volcanoes", kCell, 1);
    const Bool isVolcano = p.random2D("is volcano", p.x() + cell.offset.x, p.y() + cell.offset.y) < kChance;
    const Float outside = clamp(1.0f - cell.distance * (1.0f / kRadius), 0.0f, 1.0f);
    const Float cone = outside * outside * kRise;
    const Float crater = smoothstep(kCrater, kCrater * 0.4f, cell.distance) * 24.0f;
    return {select(isVolcano, cone - crater, Float(0.0f)), select(isVolcano, outside, Float(0.0f))};
}

}  // namespace

Float canyonLand(Float temperature, Float moisture) {
    return smoothstep(0.22f, 0.34f, temperature) * smoothstep(-0.02f, -0.12f, moisture) *
           smoothstep(-0.62f, -0.5f, moisture);
}

Float desert(Float temperature, Float moisture) {
    return smoothstep(0.2f, 0.32f, temperature) * smoothstep(-0.42f, -0.55f, moisture);
}

Float karst(Float temperature, Float moisture) {
    return smoothstep(0.2f, 0.32f, temperature) * smoothstep(0.2f, 0.32f, moisture);
}

Shape shape(Pass& p) {
    Shape s{0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    const Volcano volcano = volcanoAt(p);
    s.volcanic = volcano.share;
    s.land = landNoise(p);
    s.temperature = temperatureAt(p);
    s.moisture = moistureAt(p, s.land);
    s.mountains = rangesAt(p, s.land);
    const Float isLand = smoothstep(0.0f, 0.1f, s.land);
    const Float hilly = smoothstep(-0.3f, 0.5f, p.simplex2D("hilly", 512, {.3f, 1.0f}));
    const Float hills = p.simplex2D("hills", 128, {.25f, .5f, 1.0f}) + 0.55f;
    s.base = kSea + 1.0f + plainHeight(s.land) + rangeHeight(p, s.mountains) +
             hills * isLand * (hilly * 17.0f + 2.5f) + volcano.rise;
    return s;
}

Float coarseHeight(Pass& p) {
    const Float land = landNoise(p), mountains = rangesAt(p, land);
    return kSea + 1.0f + plainHeight(land) + rangeHeight(p, mountains) + volcanoAt(p).rise;
}

void shapePass(Pass& p, const Fields& f) {
    const Shape s = shape(p);
    p.set(f.land, s.land);
    p.set(f.temperature, s.temperature);
    p.set(f.moisture, s.moisture);
    p.set(f.mountains, s.mountains);
    p.set(f.volcanic, s.volcanic);
    p.set(f.base, s.base);
}

}  // namespace terrane::gen::continents
