#include <utility>

#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/generators/wilderness.h"

// Biomes of wilderness and what the ground is made of.

namespace terrane::gen::wilderness {

namespace {

constexpr float kColder = 0.00062f;  // by block of height: the snow line of a temperate land is near 1,000

// Inputs to the choice of a biome. Noise in temperature and moisture roughens borders.
struct Site {
    Float height, steepness, temperature, moisture;
    Float cold;   // the temperature at the ground's height, lower on slopes that face north
    Float rough;  // of borders
    Int surface;  // z of the highest ground block
};

constexpr int kMaxHeldStep = 4;  // wider columns are too far away for it

// z of the highest ground block. Ground holds the water beside it: a column between two rivers, or a river
// and a lake, belongs to one of them and does not know the other.
Int heldSurface(Pass& p, const Fields& f) {
    const int step = p.step();
    const Int own = Int(floor(p.read(f.height)));
    if (step > kMaxHeldStep) return own;
    Var<Int> held = p.var(own);
    p.if_(own >= p.read(f.water), [&] {
        Int highest = own;
        for (const auto& [dx, dy] : {std::pair{step, 0}, {-step, 0}, {0, step}, {0, -step}}) {
            const Int water = p.readAt(f.water, {Int(dx), Int(dy)});
            highest =
                max(highest, select(Int(floor(p.readAt(f.height, {Int(dx), Int(dy)}))) < water, water, own));
        }
        held = highest;
    });
    return held;
}

Site site(Pass& p, const Fields& f) {
    const Float rough = p.perlin2DWithGrain("biome borders", 8, {.03f, .03f, .04f, .05f});
    const Float height = p.read(f.height);
    const Vec2 slope = p.slope(f.height);
    const Float temperature = p.read(f.temperature) + rough;
    const Float shaded = clamp(p.slope(f.base).y, -1.0f, 1.0f) * -0.07f;
    return {height,
            length(slope),
            temperature,
            p.read(f.moisture) + rough,
            temperature + shaded - max(height - kSea, Float(0.0f)) * kColder,
            rough,
            heldSurface(p, f)};
}

Int biomeOf(Pass& p, const Fields& f, const Site& s) {
    const auto is = [](Biome b) { return number(b); };
    const Float t = s.temperature, m = s.moisture, land = p.read(f.land);
    const Float patches = p.perlin2D("woods of one kind", 128, {.3f, .6f, 1.0f}) + s.rough;
    const Float shore = p.perlin2D("beach width", 64, {.4f, 1.0f}) * 0.008f + 0.009f;
    const Bool isSea = s.height < kSea + 0.5f && (land < 0.05f || p.read(f.range) > 0.2f);
    const Float floor = s.height + s.rough * 70.0f;  // of the sea, with the grain of borders
    const Bool isShallow = floor > kSea - 18.0f, isDeep = floor < kSea - 60.0f;
    const Int sea =
        multiSelect({{isDeep, is(Biome::DeepOcean)},
                     {isShallow && t > 0.2f, is(Biome::Reef)},
                     {floor > kSea - 30.0f && t < 0.05f && patches > 0.05f, is(Biome::KelpForest)}},
                    is(Biome::Ocean));
    const Bool isCoast = land < shore && s.height < kSea + 4.0f;
    const Bool isLow = s.height < kSea + 14.0f && length(p.slope(f.base)) < 0.35f;
    const Int coast = multiSelect({{s.steepness > 0.7f, is(Biome::StonyShore)},
                                   {t > 0.25f && m > 0.1f && patches > 0.0f, is(Biome::Mangrove)}},
                                  is(Biome::Beach));
    const Int hot = multiSelect({{m < -0.48f, is(Biome::Desert)},
                                 {m < -0.2f && p.read(f.canyon) > 0.1f, is(Biome::Badlands)},
                                 {m < -0.22f, is(Biome::Shrubland)},
                                 {m < 0.12f, is(Biome::Savanna)},
                                 {s.height > kSea + 220.0f, is(Biome::CloudForest)},
                                 {patches > 0.38f, is(Biome::BambooForest)}},
                                is(Biome::RainForest));
    const Int temperate = multiSelect({{m < -0.4f, is(Biome::Steppe)},
                                       {p.read(f.canyon) > 0.3f, is(Biome::Badlands)},
                                       {m < -0.12f, is(Biome::Meadow)},
                                       {isLow && m > 0.08f, is(Biome::Swamp)},
                                       {m > 0.42f, is(Biome::GiantForest)},
                                       {m > 0.26f, is(Biome::OldForest)},
                                       {t < 0.0f && patches > 0.1f, is(Biome::MapleForest)},
                                       {t < 0.05f, is(Biome::BirchForest)},
                                       {patches > 0.45f, is(Biome::CherryGrove)},
                                       {patches < -0.2f, is(Biome::BeechForest)}},
                                      is(Biome::OakForest));
    const Int cool = multiSelect({{isLow && m > 0.1f, is(Biome::Bog)},
                                  {p.read(f.range) > 0.2f, is(Biome::FirForest)},
                                  {patches > 0.25f, is(Biome::LarchForest)}},
                                 is(Biome::Taiga));
    const Bool isHigh = s.height > kSea + 250.0f;
    return multiSelect({{isSea, sea},
                        {isCoast, coast},
                        {p.read(f.volcanic) + s.rough > patches * 0.1f + 0.55f, is(Biome::LavaField)},
                        {s.steepness > 1.6f && isHigh, is(Biome::Rocks)},
                        {s.cold < -0.75f && isHigh && s.steepness < 0.8f, is(Biome::Glacier)},
                        {s.cold < -0.6f, is(Biome::Snow)},
                        {s.cold < -0.34f && isHigh, is(Biome::AlpineMeadow)},
                        {s.cold < -0.4f, is(Biome::Tundra)},
                        {s.cold < -0.14f, cool},
                        {t > 0.24f && s.cold > 0.1f, hot}},
                       temperate);
}

struct Ground {
    Block top, soil, rock;
};

// Top block of a biome on gentle ground. `patches` and `spots`: noise of about 30 and 8 blocks.
Block biomeTop(Pass& p, const Site& s, Int biome, Float patches, Float spots) {
    const auto is = [&](Biome b) { return biome == number(b); };
    const auto block = [&](const char* name) { return p.block(name); };
    const Block tundra =
        select(spots > 0.25f, block("moss"), select(patches > 0.35f, block("gravel"), block("grass")));
    const Block alpine = multiSelect({{s.cold < spots * 0.05f - 0.57f, block("snow")},
                                      {s.cold < spots * 0.12f - 0.53f, block("stone")},
                                      {spots > 0.5f, block("gravel")}},
                                     block("grass"));
    const Block marsh =
        multiSelect({{spots > 0.3f, block("moss")}, {patches > 0.1f, block("mud")}}, block("grass"));
    const Block sea =
        multiSelect({{s.height > kSea - 12.0f, select(s.cold < -0.3f, block("gravel"), block("sand"))},
                     {patches > 0.3f, block("clay")},
                     {patches < -0.25f, block("gravel")}},
                    block("sand"));
    const Block lava = select(spots > 0.2f, block("gravel"), block("basalt"));
    return multiSelect({{is(Biome::Ocean) || is(Biome::DeepOcean) || is(Biome::KelpForest), sea},
                        {is(Biome::Reef) || is(Biome::Desert), block("sand")},
                        {is(Biome::Beach), select(s.cold < -0.25f, block("gravel"), block("sand"))},
                        {is(Biome::StonyShore), select(spots > 0.2f, block("gravel"), block("stone"))},
                        {is(Biome::Mangrove), select(spots > 0.2f, block("mud"), block("sand"))},
                        {is(Biome::Badlands), select(patches > 0.4f, block("grass"), block("red_sand"))},
                        {is(Biome::Snow) || is(Biome::Glacier), block("snow")},
                        {is(Biome::Tundra), select(s.cold < spots * 0.12f - 0.54f, block("snow"), tundra)},
                        {is(Biome::Taiga) || is(Biome::FirForest),
                         select(patches > 0.2f && spots > 0.1f, block("moss"), block("grass"))},
                        {is(Biome::AlpineMeadow), alpine},
                        {is(Biome::Rocks), block("stone")},
                        {is(Biome::LavaField), lava},
                        {is(Biome::Swamp) || is(Biome::Bog), marsh},
                        {(is(Biome::OldForest) || is(Biome::RainForest) || is(Biome::CloudForest) ||
                          is(Biome::GiantForest)) &&
                             spots > 0.3f,
                         block("moss")}},
                       block("grass"));
}

// The rock of a region: of a climate's landforms, else of a wide noise.
Block rockOf(Pass& p, const Fields& f, Float patches) {
    const Float temperature = p.read(f.temperature), moisture = p.read(f.moisture);
    const Float kinds = p.perlin2D("kinds of rock", 512, {.1f, .2f, .5f, 1.0f});
    return multiSelect({{p.read(f.volcanic) > patches * 0.1f + 0.15f, p.block("basalt")},
                        {p.read(f.range) > patches * 0.05f + 0.2f && kinds < 0.5f, p.block("stone")},
                        {dryLand(temperature, moisture) > 0.05f, p.block("red_sandstone")},
                        {karstLand(temperature, moisture) > 0.05f, p.block("limestone")},
                        {sandLand(temperature, moisture) > 0.05f, p.block("sandstone")},
                        {kinds > 0.45f, p.block("limestone")}},
                       p.block("stone"));
}

// Limestone towers: plants cover them but for the steepest of their walls.
Bool isTower(Pass& p, const Fields& f) {
    return p.read(f.rocky) > 0.4f && p.read(f.canyon) < 0.1f;
}

Ground groundOf(Pass& p, const Fields& f, const Site& s, Int biome) {
    const Float patches = p.perlin2DWithGrain("ground patches", 16, {.3f, .4f, .6f});
    const Float spots = p.perlin2DWithGrain("ground spots", 4, {.35f, .6f});
    const Block rock = rockOf(p, f, patches);
    const Block top = biomeTop(p, s, biome, patches, spots);
    const auto is = [&](Block block, const char* name) { return block == p.block(name); };
    const Bool isSoil = is(top, "grass") || is(top, "moss") || is(top, "snow");
    const Block soil = select(isSoil, p.block("dirt"), select(is(top, "red_sand"), p.block("red_sand"), top));
    // The sod of meadows holds more than the soil of woods.
    const Float sod =
        select(biome == number(Biome::AlpineMeadow), Float(0.1f), smoothstep(0.0f, -0.4f, s.cold) * -0.2f);
    const Float bareFrom = spots * 0.25f + patches * 0.2f + 1.3f + sod;
    // Sand lies on dunes, not on mountains.
    const Bool isSandy = is(top, "sand") && biome == number(Biome::Desert);
    const Bool isDune = isSandy && p.read(f.range) < 0.1f && p.read(f.canyon) < 0.1f;
    const Float sandFrom = select(isDune, Float(0.4f), select(isSandy, Float(-0.6f), Float(0.0f)));
    const Bool isBare =
        s.steepness > select(isTower(p, f), spots * 0.9f + patches * 0.9f + 2.3f,
                             select(p.read(f.rocky) > 0.4f, spots * 0.2f + 0.6f, bareFrom + sandFrom));
    // Stones that fall from cliffs lie below them.
    const Bool isScree = p.read(f.range) > 0.15f && s.cold < 0.0f && s.steepness > bareFrom - 0.3f && !isBare;
    // Channels that water left, and what the next flood has not reached yet.
    const Float fan = p.read(f.fan);
    Var<Bool> isFan = p.var(Bool(false));
    p.if_(fan > 0.1f && !isBare, [&] {
        const Float lines = abs(p.perlin2D("channels of fans", 24, {.4f, 1.0f}));
        isFan = fan > smoothstep(0.05f, 0.3f, lines) * 0.5f + patches * 0.25f + 0.3f;
    });
    const Bool keepsSnow = is(top, "snow") && s.steepness < patches * 0.4f + 1.35f;
    const Bool isUnderWater = s.surface < p.read(f.water) && p.read(f.wet) > 0.0f && !p.read(f.isLava);
    const Block bottom = landforms::riverBed(p, patches, spots);
    // Rivers and lakes leave sand and gravel beside them, in bars here and there.
    const Bool isBank = p.read(f.wet) > 0.75f - patches * 0.35f && s.steepness < 2.2f && !isUnderWater &&
                        biome != number(Biome::Ocean);
    const Bool isBar = spots + patches > 0.1f;
    const Block bank = multiSelect({{!isBar, select(isBare, p.block("gravel"), top)},
                                    {s.cold < -0.1f || p.read(f.range) > 0.2f, p.block("gravel")},
                                    {p.read(f.moisture) > 0.2f, p.block("mud")}},
                                   p.block("sand"));
    const Bool isGravelly = isBar || isBare;
    return {multiSelect({{isUnderWater, bottom},
                         {isBank, bank},
                         {isBare && !keepsSnow, rock},
                         {(isScree || static_cast<Bool>(isFan)) && !keepsSnow, p.block("gravel")}},
                        top),
            multiSelect({{isUnderWater, bottom},
                         {isBank, select(isGravelly, p.block("gravel"), p.block("dirt"))},
                         {isBare || s.steepness > bareFrom - 0.25f, rock}},
                        soil),
            rock};
}

// z below which caves may be. The roof has holes, the mouths, in spots where its thickness is negative.
Int caveTop(Pass& p, const Fields& f, const Site& s) {
    const Float mouths = smoothstep(0.42f, 0.7f, p.perlin2D("cave mouths", 24, {.2f, 1.0f}));
    const Bool isDry = s.height > kSea + 5.0f && p.read(f.wet) <= 0.0f;
    const Float roof = select(isDry, Float(8.0f) - mouths * 16.0f, Float(12.0f)) + s.steepness * 2.0f;
    // Caves do not open the water of sinkholes, nor the pools of hot springs.
    const Bool isBesideWater = besideSinkhole(p, f, 0.01f) < 26.0f;
    const Float thick = select(p.read(f.spring) > 0.0f, Float(12.0f), roof);
    // Nor the notches of cliffs.
    const Float land = p.read(f.land);
    const Float below =
        select(land > -0.04f && land < 0.012f, Float(kSea - 14.0f), Float(static_cast<float>(kNoSpan)));
    const Float highest = min(select(isBesideWater, Float(kSea - 34.0f), s.height - thick), below);
    return select(isShaft(p, f) && !isBesideWater, s.surface + kShaftMark, Int(floor(highest)));
}

// The ground shows at its sides down to the columns beside, and farther beside tiles of another level.
Int hiddenBelow(Pass& p, const Fields& f) {
    constexpr float kMore = 4.0f;
    const Float height = p.read(f.height);
    return Int(floor(height - max(height - p.lowestBeside(f.height), Float(0.0f)) * 2.0f - kMore));
}

}  // namespace

void surfacePass(Pass& p, const Fields& f) {
    const Site s = site(p, f);
    p.set(f.surface, s.surface);
    const Int biome = biomeOf(p, f, s);
    const Ground ground = groundOf(p, f, s, biome);
    p.set(f.biome, biome);
    p.set(f.top, springGround(p, p.read(f.spring), ground.top));
    p.set(f.soil, springGround(p, p.read(f.spring), ground.soil));
    p.set(f.rock, ground.rock);
    p.set(f.cold, s.cold);
    const Float steepest = select(isTower(p, f), Float(2.8f), Float(1.35f));
    const Float gentle = smoothstep(steepest, steepest - 0.4f, s.steepness);
    const Bool isDry = s.surface >= p.read(f.water);
    p.set(f.forest, select(isDry, gentle * (1.0f - p.read(f.fan) * 0.6f), Float(0.0f)));
    if (p.step() == 1) {
        p.set(f.caveTop, caveTop(p, f, s));
    } else {
        p.set(f.hidden, hiddenBelow(p, f));
    }
}

void colorPass(Pass& p, const Fields& f) {
    const Float high = max(p.read(f.base) - kSea, Float(0.0f)) * kColder;
    p.set(f.color, vegetation::grassColor(p, p.read(f.temperature) - high, p.read(f.moisture)));
}

}  // namespace terrane::gen::wilderness
