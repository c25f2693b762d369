#include "terrane/gen/generators/continents.h"
#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/language/expr.h"

namespace terrane::gen::continents {

// Biomes of continents and what the ground is made of.

namespace {

// Inputs to the choice of a biome. Noise in temperature and moisture roughens borders.
struct Site {
    Float height, steepness, temperature, moisture;
    Float cold;  // the temperature at the ground's height
};

Site site(Pass& p, const Fields& f) {
    const Float rough = p.perlin2DWithGrain("biome borders", 8, {.03f, .03f, .04f, .05f});
    const Float height = p.read(f.height);
    const Float cooler = max(height - (kSea + 20.0f), Float(0.0f)) * 0.0045f;
    const Float temperature = p.read(f.temperature) + rough;
    return {height, length(p.slope(f.height)), temperature, p.read(f.moisture) + rough, temperature - cooler};
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
    const Bool isLow = s.height < kSea + 9.0f && s.steepness < 0.35f;
    const Int temperate = multiSelect({{m < -0.24f, is(Biome::Meadow)},
                                       {isLow && m > 0.0f, is(Biome::Swamp)},
                                       {m > 0.36f, is(Biome::OldForest)},
                                       {t < 0.07f, is(Biome::BirchForest)}},
                                      is(Biome::OakForest));
    return multiSelect({{isSea && isReef, is(Biome::Reef)},
                        {isSea, is(Biome::Ocean)},
                        {isBeach, is(Biome::Beach)},
                        {s.cold < -0.64f, is(Biome::Snow)},
                        {p.read(f.mountains) > 0.2f && s.cold < t - 0.17f && t < 0.4f, is(Biome::Alpine)},
                        {s.cold < -0.42f, is(Biome::Tundra)},
                        {s.cold < -0.16f, is(Biome::Taiga)},
                        {t > 0.26f, hot}},
                       temperate);
}

struct Ground {
    Block top, soil, rock;
};

// Top block of a biome on gentle ground. `patches` and `spots`: noise of about 30 and 8 blocks.
Block biomeTop(Pass& p, const Site& s, Int biome, Float patches, Float spots) {
    const auto is = [&](Biome b) { return biome == number(b); };
    const auto block = [&](const char* name) { return p.block(name); };
    const Block cold =
        select(spots > 0.25f, block("moss"), select(patches > 0.35f, block("gravel"), block("grass")));
    const Block alpine = multiSelect({{s.cold < spots * 0.06f - 0.38f, block("snow")},
                                      {s.cold < spots * 0.2f - 0.22f, block("stone")},
                                      {spots > 0.45f, block("gravel")}},
                                     block("grass"));
    const Block swamp =
        multiSelect({{spots > 0.3f, block("moss")}, {patches > 0.1f, block("mud")}}, block("grass"));
    const Block sea =
        multiSelect({{s.height > kSea - 9.0f, select(s.cold < -0.3f, block("gravel"), block("sand"))},
                     {patches > 0.3f, block("clay")},
                     {patches < -0.25f, block("gravel")}},
                    block("sand"));
    return multiSelect(
        {{is(Biome::Ocean), sea},
         {is(Biome::Reef) || is(Biome::Desert), block("sand")},
         {is(Biome::Beach), select(s.cold < -0.25f, block("gravel"), block("sand"))},
         {is(Biome::CanyonLand), select(patches > 0.35f, block("grass"), block("red_sand"))},
         {is(Biome::Snow), block("snow")},
         {is(Biome::Tundra), select(s.cold < spots * 0.12f - 0.54f, block("snow"), cold)},
         {is(Biome::Taiga), select(patches > 0.2f && spots > 0.1f, block("moss"), block("grass"))},
         {is(Biome::Alpine), alpine},
         {is(Biome::Swamp), swamp},
         {(is(Biome::OldForest) || is(Biome::RainForest)) && spots > 0.3f, block("moss")}},
        block("grass"));
}

Block rockOf(Pass& p, const Fields& f, Int biome, Float patches) {
    const auto is = [&](Biome b) { return biome == number(b); };
    // Follows the landforms, whose borders differ from those of the biomes.
    const Float temperature = p.read(f.temperature), moisture = p.read(f.moisture);
    return multiSelect(
        {{p.read(f.volcanic) > patches * 0.1f + 0.15f, p.block("basalt")},
         {canyonLand(temperature, moisture) > 0.05f || is(Biome::CanyonLand), p.block("red_sandstone")},
         {karst(temperature, moisture) > 0.05f || is(Biome::RainForest), p.block("limestone")},
         {is(Biome::Desert), p.block("sandstone")}},
        p.block("stone"));
}

Ground groundOf(Pass& p, const Fields& f, const Site& s, Int biome) {
    const Float patches = p.perlin2DWithGrain("ground patches", 16, {.3f, .4f, .6f});
    const Float spots = p.perlin2DWithGrain("ground spots", 4, {.35f, .6f});
    const Block rock = rockOf(p, f, biome, patches);
    const Block top = biomeTop(p, s, biome, patches, spots);
    const auto is = [&](Block block, const char* name) { return block == p.block(name); };
    const Bool isSoil = is(top, "grass") || is(top, "moss") || is(top, "snow");
    const Block soil = select(isSoil, p.block("dirt"), select(is(top, "red_sand"), p.block("red_sand"), top));
    const Float bareFrom = spots * 0.25f + patches * 0.2f + 1.05f - smoothstep(0.0f, -0.4f, s.cold) * 0.2f;
    const Bool isSandy = is(top, "sand") && biome == number(Biome::Desert);
    const Bool isBare = (s.steepness > bareFrom + select(isSandy, Float(0.4f), Float(0.0f))) ||
                        (p.read(f.volcanic) > spots * 0.15f + patches * 0.1f + 0.62f) ||
                        (p.read(f.rocky) > 0.4f && s.steepness > spots * 0.2f + 0.6f);
    const Bool keepsSnow = is(top, "snow") && s.steepness < patches * 0.5f + 1.5f;
    const Bool isUnderWater = p.read(f.surface) < p.read(f.water) && p.read(f.wet) > 0.0f;
    const Block bottom = landforms::riverBed(p, patches, spots);
    return {multiSelect({{isUnderWater, bottom}, {isBare && !keepsSnow, rock}}, top),
            multiSelect({{isUnderWater, bottom}, {isBare || s.steepness > bareFrom - 0.25f, rock}}, soil),
            rock};
}

// z below which caves may be. The roof has holes, the mouths, in spots where its thickness is negative.
Int caveTop(Pass& p, const Fields& f, const Site& s) {
    const Float mouths = smoothstep(0.42f, 0.7f, p.perlin2D("cave mouths", 24, {.2f, 1.0f}));
    const Bool isDry = s.height > kSea + 5.0f && p.read(f.wet) <= 0.0f;
    const Float roof = select(isDry, Float(7.0f) - mouths * 14.0f, Float(10.0f)) + s.steepness * 2.0f;
    return Int(floor(s.height - roof));
}

}  // namespace

void surfacePass(Pass& p, const Fields& f) {
    const Site s = site(p, f);
    const Int biome = biomeOf(p, f, s);
    const Ground ground = groundOf(p, f, s, biome);
    p.set(f.biome, biome);
    p.set(f.top, ground.top);
    p.set(f.soil, ground.soil);
    p.set(f.rock, ground.rock);
    p.set(f.cold, s.cold);
    const Float gentle = smoothstep(1.1f, 0.75f, s.steepness);
    const Bool isDry = p.read(f.surface) >= p.read(f.water);
    p.set(f.forest, select(isDry, gentle, Float(0.0f)));
    if (p.step() == 1) p.set(f.caveTop, caveTop(p, f, s));
}

// Ground of continents: soil, strata, ore, water, caves and their lakes.

namespace {

constexpr int kCaveWater = 13;  // up to this height above the world's bottom caves are lakes

// Bands of rock, a little bent. Only canyon lands show theirs.
Block strata(Pass& p, const Fields& f) {
    const Int bend = Int(p.perlin2D("strata", 64, {1.5f, 3.0f}) + 8.0f);
    const Int band = floorModulo(p.z() + bend, 17);
    const Block stripes = multiSelect({{band < 4, p.block("terracotta")},
                                       {band == 9, p.block("sandstone")},
                                       {band == 13, p.block("terracotta")}},
                                      p.block("red_sandstone"));
    return select(p.read(f.rock) == p.block("red_sandstone"), stripes, p.read(f.rock));
}

// Winding tunnels where two noises are both near 0, and halls, which columns hold up.
Bool isCave(Pass& p, const Fields& f) {
    Var<Bool> result = p.var(Bool(false));
    const Float where = p.perlin2D("cave places", 128, {.5f, 1.0f});
    p.if_(p.z() > p.heights().bottom + 2 && p.z() < p.read(f.caveTop), [&] {
        p.if_(where > -0.05f, [&] { result = landforms::isTunnel(p, where); });
        p.if_(where < -0.12f, [&] {
            const Float hall =
                p.perlin3D("halls", 30, {.3f, 1.0f}) - smoothstep(0.0f, 60.0f, Float(p.z()) - 30.0f) * 0.25f;
            const Float column = p.perlin2D("columns", 5, {1.0f, .5f});
            result = hall > 0.30f && column < 0.5f;
        });
    });
    return result;
}

Block earth(Pass& p, const Fields& f) {
    constexpr int kSoilDepth = 3;
    const Int z = p.z(), depth = p.read(f.surface) - z;
    Var<Block> block = p.var(p.block("air"));
    p.if_(
        depth <= kSoilDepth,
        [&] {
            const Block top = select(p.read(f.top) == p.block("red_sandstone"), strata(p, f), p.read(f.top));
            const Block soil =
                select(p.read(f.soil) == p.block("red_sandstone"), strata(p, f), p.read(f.soil));
            block = select(depth == 0, top, soil);
        },
        [&] { block = p.step() == 1 ? landforms::withOre(p, strata(p, f), z < 72) : strata(p, f); });
    if (p.step() > 1) return block;
    const Block inside = select(z <= p.heights().bottom + kCaveWater, p.block("water"), p.block("air"));
    return select(isCave(p, f), inside, static_cast<Block>(block));
}

}  // namespace

Block ground(Pass& p, const Fields& f) {
    const Int z = p.z(), water = p.read(f.water);
    Var<Block> block = p.var(p.block("air"));
    p.if_(
        z <= p.read(f.surface), [&] { block = earth(p, f); },
        [&] {
            const Bool isIce = z == water && p.read(f.cold) < -0.78f;
            const Block liquid = select(isIce, p.block("ice"), p.block("water"));
            block = select(z <= water, liquid, p.block("air"));
        });
    return block;
}

void colorPass(Pass& p, const Fields& f) {
    const Float high = max(p.read(f.base) - (kSea + 20.0f), Float(0.0f)) * 0.0045f;
    p.set(f.color, vegetation::grassColor(p, p.read(f.temperature) - high, p.read(f.moisture)));
}

}  // namespace terrane::gen::continents
