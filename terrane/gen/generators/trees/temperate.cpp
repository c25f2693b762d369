// Trees of temperate woods and what grows below them: by space colonization (branching.h) or by grammar
// (grammar.h).

#include "terrane/gen/generators/trees/branching.h"
#include "terrane/gen/generators/trees/grammar.h"
#include "terrane/gen/generators/trees/kinds_internal.h"

namespace terrane::gen::trees {

// Tall, on a smooth pale trunk; the crown is an egg of level layers.
void drawBeech(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("pale_log", kWoodRank), leaves = canvas.paint("birch_leaves", kLeafRank);
    Branches branches;
    const float height = random.between(18.0f, 24.0f), width = random.between(6.0f, 7.5f);
    growTrunk(branches, height * .72f, random.between(.2f, 1.0f), random);
    const Crown crown = {{0, 0, height * .62f}, {width, width, height * .38f}, .35f, height * .3f};
    colonize(branches, pointsIn(crown, 190, random), {8, 2.0f, 1.2f, {0, 0, .3f}, .2f}, random);
    setRadii(branches, 1.3f);
    drawLimbs(canvas, branches, wood, 2);
    drawRoots(canvas, 6, 3.0f, .8f, wood, random);
    drawFoliage(canvas, branches, {{2.1f, 2.1f, 1.15f}, .4f, 2}, leaves, random);
}

// A short trunk that divides into rising limbs; a round crown in autumn colors.
void drawMaple(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("oak_log", kWoodRank), leaves = canvas.paint("maple_leaves", kLeafRank);
    Branches branches;
    const float height = random.between(11.0f, 15.0f), width = random.between(4.8f, 6.2f);
    growTrunk(branches, 3.0f, random.between(0.0f, .6f), random);
    const int fork = static_cast<int>(branches.size() - 1), limbs = random.between(3, 4);
    const float first = random.unit();
    for (int k = 0; k < limbs; ++k) {
        const Point out = heading(turnsOf(k, limbs, first, random)) * (width * .35f);
        const Point from = branches[static_cast<std::size_t>(fork)].at;
        addLine(branches, fork, from + Point{0, 0, 1}, from + out + Point{0, 0, height * .35f});
    }
    const Crown crown = {{0, 0, height * .62f}, {width, width, height * .4f}, .55f, height * .32f};
    colonize(branches, pointsIn(crown, 110, random), {8, 2.2f, 1, {0, 0, .2f}, .25f}, random);
    setRadii(branches, 1.1f);
    drawLimbs(canvas, branches, wood, 2);
    drawRoots(canvas, 5, 2.2f, .6f, wood, random);
    drawFoliage(canvas, branches, {{1.8f, 1.8f, 1.3f}, .3f, 1}, leaves, random);
}

// A slim pale trunk, bare for half of its height, and a narrow golden crown.
void drawAspen(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("pale_log", kWoodRank), leaves = canvas.paint("aspen_leaves", kLeafRank);
    Branches branches;
    const float height = random.between(13.0f, 18.0f), width = random.between(2.4f, 3.1f);
    growTrunk(branches, height - 1, random.between(.2f, 1.2f), random);
    const Point top = branches.back().at;
    const Crown crown = {
        {top.x * .8f, top.y * .8f, height * .72f}, {width, width, height * .33f}, .3f, height * .4f};
    colonize(branches, pointsIn(crown, 70, random), {5, 1.6f, 1, {0, 0, .1f}, .25f}, random);
    setRadii(branches, .6f);
    drawLimbs(canvas, branches, wood, 2);
    drawFoliage(canvas, branches, {{1.4f, 1.4f, 1.2f}, .35f, 1}, leaves, random);
}

// A spindle: all branches rise steeply along the trunk.
void drawPoplar(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("willow_log", kWoodRank), leaves = canvas.paint("oak_leaves", kLeafRank);
    constexpr Rule kRules[] = {
        {'T', 1.0f, "F[/&B]/F[/&B]/T"},
        {'B', .5f, "FLF^FL"},
        {'B', .5f, "FLF^FLFL"},
    };
    const float step = random.between(.95f, 1.15f);
    const Grammar grammar = {"FT", kRules, random.between(9, 11), step, .085f, .382f, .8f, .2f, {0, 0, .06f}};
    Growth growth = growByGrammar(grammar, random);
    setRadii(growth.branches, .9f);
    drawLimbs(canvas, growth.branches, wood, 6);
    const float top = growth.branches.back().at.z;
    drawRoots(canvas, 3, 1.6f, .5f, wood, random);
    for (const Tuft& tuft : growth.tufts) {
        const float t = shared::detDivide(tuft.at.z, top);
        const float size = (t < .3f ? .7f + t : 1.25f - .8f * t) * random.between(.8f, 1.1f);
        canvas.clump(tuft.at, Point{1.4f, 1.4f, 1.8f} * size, .45f, leaves, random);
    }
}

// A wide vase of dark limbs with clouds of blossom.
void drawCherry(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("spruce_log", kWoodRank),
               leaves = canvas.paint("cherry_leaves", kLeafRank);
    constexpr Rule kRules[] = {
        {'T', 1.0f, "[/&&B]/[/&&B]/[/&&B]/[/&&C][&C]"},
        {'B', .6f, "FF^F[+&FL]F[-FFL]^FL"},
        {'B', .4f, "FFF[-&FL]F[+^FL]FL"},
        {'C', 1.0f, "F^F[/&&FL]F[/&&&FL]FL"},
    };
    const Grammar grammar = {"FFT", kRules, 2,           random.between(1.1f, 1.4f), .1f, .333f,
                             .8f,   .25f,   {0, 0, .05f}};
    Growth growth = growByGrammar(grammar, random);
    setRadii(growth.branches, .9f);
    drawLimbs(canvas, growth.branches, wood);
    drawRoots(canvas, 4, 1.6f, .5f, wood, random);
    for (const Tuft& tuft : growth.tufts) {
        const float size = random.between(.8f, 1.15f);
        canvas.clump(tuft.at + Point{0, 0, .3f}, Point{2.0f, 2.0f, 1.2f} * size, .3f, leaves, random);
    }
}

// Many thin stems from one root, which lean outward.
void drawHazel(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("oak_log", kWoodRank), leaves = canvas.paint("birch_leaves", kLeafRank);
    constexpr Rule kRules[] = {
        {'S', .5f, "[/&A]/[/&&A]/[/&&A]/[/A]"},
        {'S', .5f, "[/&A]/[/&&A]/[/&A]/[/&&A]/[/&&A]"},
        {'A', .6f, "FFF&FL[+FL]F[-FL]FL"},
        {'A', .4f, "FFF&F[/&FL]FLFL"},
    };
    const Grammar grammar = {"S", kRules, 2, random.between(.95f, 1.2f), .06f, .23f, .8f, .3f, {0, 0, .03f}};
    Growth growth = growByGrammar(grammar, random);
    setRadii(growth.branches, .4f);
    drawLimbs(canvas, growth.branches, wood, 2);
    for (const Tuft& tuft : growth.tufts) canvas.clump(tuft.at, {1.8f, 1.8f, 1.2f}, .3f, leaves, random);
}

namespace {

// A stem with a few twigs. Below the first fork it is bare.
constexpr Rule kSaplingRules[] = {
    {'A', .6f, "F[/&&FL]LA"},
    {'A', .4f, "F[/&&L]F[/&FL]LA"},
};

void drawSapling(Canvas& canvas, int rounds, Point radii, Canvas::Paint wood, Canvas::Paint leaves,
                 Random& random) {
    const Grammar grammar = {"FA", kSaplingRules, rounds, 1, .11f, .382f, .8f, .3f, {0, 0, .04f}};
    Growth growth = growByGrammar(grammar, random);
    setRadii(growth.branches, .45f);
    drawLimbs(canvas, growth.branches, wood, 2);
    for (const Tuft& tuft : growth.tufts) canvas.clump(tuft.at, radii, .35f, leaves, random);
}

}  // namespace

void drawYoungOak(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("oak_log", kWoodRank), leaves = canvas.paint("oak_leaves", kLeafRank);
    drawSapling(canvas, random.between(2, 3), {1.7f, 1.7f, 1.2f}, wood, leaves, random);
}

void drawYoungBirch(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("birch_log", kWoodRank), leaves = canvas.paint("birch_leaves", kLeafRank);
    drawSapling(canvas, 2, {1.2f, 1.2f, 1.2f}, wood, leaves, random);
}

}  // namespace terrane::gen::trees
