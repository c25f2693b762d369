// Biomes of continents and what the ground is made of.
#include "terrane/gen/generators/continents.h"

namespace terrane::gen::continents {
namespace {

// What decides on a column's biome. Borders are as rough as the ground.
struct Site {
    Float height, steepness, temperature, moisture, snow;
};

Site site(Pass& p, const Fields& f) {
    const Float rough = p.perlin2DWithGrain("biome borders", 8, {.03f, .03f, .04f, .05f});
    const Float height = p.read(f.height);
    const Vec2 slope = p.slope(f.height);
    const Float cooler = max(height - (kSea + 20.0f), Float(0.0f)) * 0.0045f;
    const Float temperature = p.read(f.temperature) + rough;
    return {height, length(slope), temperature, p.read(f.moisture) + rough, temperature - cooler};
}

Int biomeOf(Pass& p, const Fields& f, const Site& s) {
    const auto is = [](Biome b) { return number(b); };
    const Float t = s.temperature, m = s.moisture;
    const Float shore = p.perlin2D("beach width", 64, {.4f, 1.0f}) * 0.008f + 0.007f;
    const Bool isSea = s.height < kSea + 0.5f && p.read(f.land) < 0.05f;
    const Bool isReef = t > 0.25f && s.height > kSea - 16.0f;
    const Bool isBeach = p.read(f.land) < shore && s.height < kSea + 3.5f && s.steepness < 0.8f;
    const Int hot = multiSelect({{m < -0.5f, is(Biome::Desert)},
                                 {m < -0.06f, is(Biome::CanyonLand)},
                                 {m < 0.22f, is(Biome::Savanna)}},
                                is(Biome::RainForest));
    const Bool isWet = s.height < kSea + 8.0f && s.steepness < 0.35f;
    const Int temperate = multiSelect({{m < -0.18f, is(Biome::Meadow)},
                                       {isWet && m > 0.1f, is(Biome::Swamp)},
                                       {m > 0.34f, is(Biome::OldForest)},
                                       {t < 0.02f, is(Biome::BirchForest)}},
                                      is(Biome::OakForest));
    return multiSelect({{isSea && isReef, is(Biome::Reef)},
                        {isSea, is(Biome::Ocean)},
                        {isBeach, is(Biome::Beach)},
                        {s.snow < -0.62f, is(Biome::Snow)},
                        {p.read(f.mountains) > 0.2f && s.snow < t - 0.22f && t < 0.4f, is(Biome::Alpine)},
                        {s.snow < -0.42f, is(Biome::Tundra)},
                        {s.snow < -0.16f, is(Biome::Taiga)},
                        {t > 0.26f, hot}},
                       temperate);
}

}  // namespace

void surfacePass(Pass& p, const Fields& f) {
    const Site s = site(p, f);
    const Int biome = biomeOf(p, f, s);
    const auto isIn = [&](Biome b) { return biome == number(b); };
    const Bool isSandy = isIn(Biome::Beach) || isIn(Biome::Desert) || isIn(Biome::Ocean) || isIn(Biome::Reef);
    const Block stone = p.block("stone");
    const Float patches = p.perlin2DWithGrain("ground patches", 8, {.3f, .3f, .6f});
    const Bool isCliff = s.steepness > 1.05f + patches * 0.25f;
    const Block top = multiSelect({{isIn(Biome::Snow) && s.steepness < 1.6f, p.block("snow")},
                                   {isCliff, stone},
                                   {isSandy, p.block("sand")},
                                   {s.snow < -0.36f + patches * 0.05f && s.steepness < 1.3f && isIn(Biome::Alpine), p.block("snow")}},
                                  p.block("grass"));
    p.set(f.biome, biome);
    p.set(f.top, top);
    p.set(f.soil, select(isCliff, stone, select(isSandy, p.block("sand"), p.block("dirt"))));
    p.set(f.rock, stone);
}

}  // namespace terrane::gen::continents
