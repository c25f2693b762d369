// The overworld's climate and the height of its ground.
#include "terrane/gen/generators/overworld.h"
#include "terrane/gen/language/compounds.h"

namespace terrane::gen::overworld {
namespace {

struct Waters {
    Float ocean, river;
};

// Islands are pieces of land put into the open sea. Rivers flow around them.
Waters waters(Pass& p) {
    const Float seas = p.perlin2D("ocean", 64, {.015f, .035f, .08f, .18f, .5f, 1.0f}) - 0.18f;
    const Float islands =
        smoothstep(0.3f, 0.85f, p.perlin2D("islands", 64, {.08f, .3f, 1.0f})) * smoothstep(0.05f, 0.3f, seas);
    return {seas - islands * 0.65f, p.perlin2D("rivers", 64, {.02f, .05f, .12f, .35f, 1.0f}) + islands};
}

// The distance to the nearest point in cells of `size` blocks. Cells too small for this level give way to
// their mean.
Float cellDistance(Pass& p, const char* name, int size, int maxPoints) {
    const float share = shareLeft(size, p.step()), mean = voronoiMean2D(maxPoints).distance;
    if (share == 0.0f) return mean;
    const Float distance = p.voronoi2D(name, size, maxPoints).distance * (1.0f / static_cast<float>(size));
    return share == 1.0f ? distance : lerp(mean, distance, share);
}

// Blocks above the valleys. Ridges run where two points of a Voronoi diagram are equally near; folds run down
// their sides and fade in the valleys.
Float crags(Pass& p) {
    const Float ridge = cellDistance(p, "ridges", 512, 2);
    const Float folds = cellDistance(p, "folds", 64, 1), spurs = cellDistance(p, "spurs", 176, 1);
    return ridge * (ridge * 200.0f + spurs * 150.0f + folds * 75.0f) - 25.0f;
}

// The higher of two Voronoi diagrams, because one alone shows its cells.
Float dunes(Pass& p) {
    constexpr int kSize = 72;
    constexpr float kMean = 0.315f;  // of the square, measured over 300,000 places
    const float share = shareLeft(kSize, p.step());
    if (share == 0.0f) return kMean;
    const Float first = p.voronoi2D("dunes", kSize, 1).distance,
                second = p.voronoi2D("more dunes", kSize, 1).distance;
    const Float crest = max(first, second) * (1.0f / kSize);
    return share == 1.0f ? crest * crest : lerp(kMean, crest * crest, share);
}

// Beyond level 0 dunes are computed only in deserts. A read across a border of a desert misses only dunes too
// low to be visible.
Float dunesOf(Pass& p, Float desert) {
    if (p.step() == 1) return dunes(p);
    Var<Float> result = p.var(Float(0.0f));
    p.if_(desert > 0.0f, [&] { result = dunes(p); });
    return result;
}

// Blocks by which straight features are displaced at most. Reads reach one block farther.
constexpr float kBend = 14.0f;
static_assert(kBend + 1 < kMaxReadOffset);

// From this step on no displacement is as large as a column.
constexpr int kStraightStep = 16;
static_assert(kBend < kStraightStep);

Vec2 bend(Pass& p) {
    const auto along = [&](const char* name) {
        return clamp(p.perlin2D(name, 24, {.12f, .3f, .9f}) * kBend, -kBend, kBend);
    };
    return {along("bend x"), along("bend y")};
}

struct River {
    Float beyond;  // how far the noise is beyond what makes the bank, from 0
    Float across;  // distance to the middle / half width, below 1 in the water
    Float depth;   // blocks, in the middle
};

// The distance to the middle of a river is its noise divided by the noise's gradient, so that the width does
// not follow the gradient. The gradient's lower bound makes lakes where it vanishes.
River rivers(Pass& p, const Fields& f) {
    const Float here = abs(p.read(f.river));
    const Float gradient = max(length(p.slope(f.river)), 0.0007f);
    const Float mouth = smoothstep(-0.12f, 0.03f, p.read(f.ocean));
    const Float halfWidth =
        (p.perlin2D("river width", 128, {.4f, 1.0f}) * 4.0f + 7.0f) * (mouth * 0.8f + 1.0f);
    Float across = here / (gradient * halfWidth);
    // A column is water where a river takes half of it.
    const auto step = static_cast<float>(p.step());
    if (p.step() > 16) across = select(halfWidth * 4.0f < step, max(across, 1.0f), across);
    return {max(here - halfWidth * gradient, 0.0f), across, halfWidth * 0.25f + 2.0f};
}

// Above z = 210 the land approaches 250 without reaching it.
Float compressPeaks(Float height) {
    const Float excess = max(height - 130.0f, 0.0f);
    return min(height, 130.0f) + excess * 40.0f / (excess + 40.0f);
}

struct Land {
    Float height;     // blocks above the sea, far from rivers and coasts
    Float bumps;      // blocks to add on slopes
    Float mountains;  // 0…1
    // Deviations of slopes that columns are too wide to show: of the land, and of the bumps on it.
    Float lostSlope, lostBumps;
};

Land land(Pass& p, const Fields& f) {
    const std::vector<float> hillWeights = {2.0f, 6.0f, 18.0f}, roughWeights = {1.6f, 3.2f, 6.0f, 12.0f},
                             bumpWeights = {.8f, 1.3f, 1.3f};
    const Float desert = p.read(f.desert);
    // Ranges run along the lines where a noise is zero.
    const Float range = abs(p.perlin2D("ranges", 256, {.15f, .35f, 1.0f}));
    const Float mountainness = p.perlin2D("mountainness", 256, {.2f, .4f, 1.0f}) + 0.5f - range * 1.3f;
    const Float mountains = smoothstep(-0.15f, 0.35f, mountainness) * (1.0f - desert * 0.6f);
    const Float hilliness = clamp(abs(p.perlin2D("hilliness", 128, {.3f, .5f, .7f})) * 1.6f, 0.0f, 1.0f);
    const Float base = clamp(p.perlin2D("base", 1024, {.33f, .66f}) + 0.25f, 0.0f, 1.0f) * 30.0f;
    const Float plains = max(p.perlin2D("plains", 32, {.6f, 1.2f, 2.5f}) + 3.0f, 0.0f);
    const Float hills = (p.perlin2D("hills", 32, hillWeights) + 14.0f) * hilliness;
    const bool isBent = p.step() < kStraightStep;
    const Vec2 offset = isBent ? bend(p) : Vec2{0.0f, 0.0f};
    const auto bent = [&](Field<Float> field) {
        return isBent ? p.readBetween(field, offset) : p.read(field);
    };
    const Float roughness = p.perlin2D("roughness", 8, roughWeights);
    const Float peaks = (bent(f.crags) + roughness) * mountains;
    const Float dunes = (bent(f.dunes) * 18.0f + p.perlin2D("sand", 64, {2.0f, 6.0f})) * desert;
    // Slopes without bumps would look like contour lines.
    const Float bumpiness = clamp(max(hilliness * 1.5f, mountains) + 0.2f, 0.0f, 1.0f) * (1.0f - desert);
    const Float bumps = p.perlin2D("bumps", 4, bumpWeights) * bumpiness;
    const Float lost =
        select(peaks > hills, mountains * lostSlope(roughWeights, 8, p.step()),
               select(dunes > hills, Float(0.0f), hilliness * lostSlope(hillWeights, 32, p.step())));
    return {base + max(max(dunes, hills), max(peaks, plains)), bumps, mountains, lost,
            bumpiness * lostSlope(bumpWeights, 4, p.step())};
}

// Lost slope of the ground. `scale`: the share of the land's height that is left near rivers and coasts. High
// peaks are flattened.
Float lostGroundSlope(const Land& l, Float raised, Float scale) {
    const Float flattened = 40.0f / (max(l.height - 130.0f, 0.0f) + 40.0f);
    const Float ofLand = l.lostSlope * scale * (flattened * flattened);
    const Float ofBumps = l.lostBumps * smoothstep(2.0f, 9.0f, raised);
    return length({ofLand, ofBumps});
}

}  // namespace

void climatePass(Pass& p, const Fields& f) {
    const Float temperature =
        clamp(p.perlin2D("temperature", 16, {.02f, .02f, .05f, .05f, .2f, .4f, 2.0f}) * 0.9f, -1.0f, 1.0f);
    const Waters w = waters(p);
    p.set(f.ocean, w.ocean);
    p.set(f.river, w.river);
    p.set(f.temperature, temperature);
    const Float desert = smoothstep(0.55f, 0.8f, temperature);
    p.set(f.desert, desert);
    p.set(f.crags, crags(p));
    p.set(f.dunes, dunesOf(p, desert));
}

void reliefPass(Pass& p, const Fields& f) {
    const Float ocean = p.read(f.ocean);
    const River river = rivers(p, f);
    const Land l = land(p, f);
    const Float inland = smoothstep(0.0f, 0.35f, -ocean);
    const Float valley = smoothstep(0.0f, l.mountains * 0.36f + 0.14f, river.beyond);
    // Beaches and banks: level with the sea at the waterside, then a little above it.
    const Float shore = min(smoothstep(0.02f, -0.02f, ocean), clamp(river.across - 1.0f, 0.0f, 1.0f)) * 1.4f;
    const Float seaFloor = sqrt(max(ocean, 0.0f)) * -40.0f +
                           p.perlin2D("sea floor", 32, {1.0f, 2.0f, 4.0f}) * smoothstep(0.05f, 0.3f, ocean);
    const Float raised = compressPeaks(l.height) * inland * valley;
    const Float ground = select(ocean > 0.0f, seaFloor, raised + l.bumps * smoothstep(2.0f, 9.0f, raised));
    const Float bed = (min(river.across * river.across, 1.0f) - 1.0f) * river.depth;
    if (p.step() > 1) p.set(f.lostSlope, lostGroundSlope(l, raised, inland * valley));
    p.set(f.height, kSea + select(river.across < 1.0f, min(bed, ground + shore), ground + shore));
}

}  // namespace terrane::gen::overworld
