// Plants of dry and hot lands.
#include "terrane/gen/generators/trees/branching.h"
#include "terrane/gen/generators/trees/grammar.h"
#include "terrane/gen/generators/trees/kinds_internal.h"

namespace terrane::gen::trees {
namespace {

// A crown flat as a table: two layers, the upper one smaller.
void drawTable(Canvas& canvas, Point middle, float radius, Canvas::Paint leaves, Random& random) {
    canvas.clump(middle, {radius, radius, .8f}, .45f, leaves, random);
    canvas.clump(middle + Point{0, 0, 1}, {radius * .62f, radius * .62f, .8f}, .4f, leaves, random);
}

// A leaf of a palm: up and out, then down.
void drawFrond(Canvas& canvas, Point from, float turns, float length, Canvas::Paint leaves) {
    const Point out = heading(turns), side = {-out.y, out.x, 0};
    const int steps = static_cast<int>(length * 2.0f);
    for (int k = 0; k <= steps; ++k) {
        const float s = static_cast<float>(k) * .5f, t = shared::detDivide(s, length);
        const Point at = from + out * s + Point{0, 0, 2.2f * t - 4.2f * t * t};
        canvas.set(roundToInt(at.x), roundToInt(at.y), roundToInt(at.z), leaves);
        if (t > .25f && t < .75f && k % 2 == 0) {
            for (const float across : {-.8f, .8f}) {
                const Point leaf = at + side * across + Point{0, 0, -.4f};
                canvas.set(roundToInt(leaf.x), roundToInt(leaf.y), roundToInt(leaf.z), leaves);
            }
        }
        // Steep parts stay joined by faces.
        if (t > .6f) canvas.set(roundToInt(at.x), roundToInt(at.y), roundToInt(at.z) + 1, leaves);
    }
}

}  // namespace

void drawAcacia(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("acacia_log", kWoodRank),
               leaves = canvas.paint("acacia_leaves", kLeafRank);
    const float turns = random.unit(), fork = random.between(2.5f, 4.0f);
    const Point low = heading(turns) * random.between(.3f, 1.2f) + Point{0, 0, fork};
    canvas.limb({0, 0, -2}, {0, 0, 0}, .5f, .5f, wood);
    canvas.limb({0, 0, 0}, low, .6f, .5f, wood);
    const int boughs = random.between(2, 4);
    for (int k = 0; k < boughs; ++k) {
        const float turn = turns + .5f +
                           (static_cast<float>(k) + random.between(-.2f, .2f)) *
                               shared::detReciprocal(static_cast<float>(boughs));
        const float reach = random.between(1.2f, 2.2f), rise = random.between(1.f, 2.f);
        const Point knee = low + heading(turn) * reach + Point{0, 0, rise};
        const float bent = turn + random.between(-.08f, .08f), length = random.between(1.0f, 2.4f);
        const Point end = knee + heading(bent) * length + Point{0, 0, random.between(1.2f, 2.6f)};
        canvas.limb(low, knee, .5f, .4f, wood);
        canvas.limb(knee, end, .4f, .4f, wood);
        drawTable(canvas, end + Point{0, 0, .6f}, random.between(2.6f, 3.9f), leaves, random);
    }
}

void drawBaobab(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("acacia_log", kWoodRank),
               leaves = canvas.paint("acacia_leaves", kLeafRank);
    const float height = random.between(8.0f, 11.0f), radius = random.between(2.0f, 2.7f);
    // A bottle: narrower at the top and a little at the foot.
    canvas.limb({0, 0, -2}, {0, 0, 2}, radius * .95f, radius, wood);
    canvas.limb({0, 0, 2}, {0, 0, height * .6f}, radius, radius * .95f, wood);
    canvas.limb({0, 0, height * .6f}, {0, 0, height}, radius * .95f, radius * .55f, wood);
    Branches branches;
    addLine(branches, -1, {0, 0, height - 2}, {0, 0, height});
    const Crown crown = {{0, 0, height + 2.5f}, {7.0f, 7.0f, 3.0f}, .65f, height};
    colonize(branches, pointsIn(crown, 34, random), {14, 2.0f, 1, {0, 0, .12f}, .3f}, random);
    setRadii(branches, radius * .6f);
    drawLimbs(canvas, branches, wood);
    for (const BranchNode& n : branches) {
        if (n.tips != 1 || n.at.z < height + .5f) continue;
        canvas.clump(n.at + Point{0, 0, .3f}, {2.0f, 2.0f, 1.0f}, .3f, leaves, random);
    }
}

void drawPalm(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("palm_log", kWoodRank), leaves = canvas.paint("palm_leaves", kLeafRank);
    const float height = random.between(7.0f, 12.0f), lean = random.between(.8f, 3.5f);
    const Point away = heading(random.unit());
    canvas.limb({0, 0, -2}, {0, 0, 0}, .5f, .5f, wood);
    // Bent most near the foot, and upright again at the top.
    const Point knee = away * (lean * .6f) + Point{0, 0, height * .45f};
    const Point top = away * lean + Point{0, 0, height};
    canvas.limb({0, 0, 0}, knee, .5f, .5f, wood);
    canvas.limb(knee, top, .5f, .5f, wood);
    const int fronds = random.between(7, 9);
    const float first = random.unit();
    for (int k = 0; k < fronds; ++k) {
        const float turn = first + (static_cast<float>(k) + random.between(-.2f, .2f)) *
                                       shared::detReciprocal(static_cast<float>(fronds));
        drawFrond(canvas, top + Point{0, 0, 1}, turn, random.between(3.6f, 5.2f), leaves);
    }
    canvas.set(roundToInt(top.x), roundToInt(top.y), roundToInt(top.z) + 1, leaves);
}

// A short thick trunk that divides into gnarled stems, each under its own cloud of silver leaves.
void drawOlive(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("acacia_log", kWoodRank), leaves = canvas.paint("olive_leaves", kLeafRank);
    canvas.limb(kRootEnd, {0, 0, 1}, 1.4f, 1.1f, wood);
    drawRoots(canvas, 4, 1.8f, .6f, wood, random);
    const int stems = random.between(2, 3);
    const float first = random.unit();
    for (int k = 0; k < stems; ++k) {
        const float turns = turnsOf(k, stems, first, random);
        const Point knee = heading(turns) * random.between(1.2f, 2.0f) + Point{0, 0, 2.4f};
        const float bent = turns + random.between(-.2f, .2f), reach = random.between(.5f, 1.4f);
        const Point fork = knee + heading(bent) * reach + Point{0, 0, random.between(1.2f, 2.2f)};
        canvas.limb({0, 0, .8f}, knee, .9f, .7f, wood);
        canvas.limb(knee, fork, .7f, .5f, wood);
        const int boughs = random.between(3, 4);
        for (int n = 0; n < boughs; ++n) {
            const float turn = turnsOf(n, boughs, turns, random), out = random.between(1.2f, 2.2f);
            const Point end = fork + heading(turn) * out + Point{0, 0, random.between(.6f, 1.8f)};
            canvas.limb(fork, end, .4f, .4f, wood);
            canvas.clump(end + Point{0, 0, .3f}, Point{1.9f, 1.9f, 1.4f} * random.between(.8f, 1.15f), .25f,
                         leaves, random);
        }
    }
}

// A tall pale trunk that bends, forks high, and holds tufts of leaves at the ends of bare limbs.
void drawEucalyptus(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("pale_log", kWoodRank), leaves = canvas.paint("olive_leaves", kLeafRank);
    constexpr Rule kRules[] = {
        {'T', 1.0f, "FFF[/&&B]/FF[/&&&B]/U"},  // the trunk, and its first limbs
        {'U', 1.0f, "FF[/&&B][//&&C]/V"},
        {'V', 1.0f, "^F[/&&C]F[/&C]FL"},
        {'B', .6f, "FF^F[/&&D]F[/^D]^FL"},
        {'B', .4f, "FF^F[/&D]F^FL"},
        {'C', 1.0f, "F^F[/&D]FL"},
        {'D', 1.0f, "F^FL"},
    };
    const float step = random.between(1.35f, 1.75f);
    const Grammar grammar = {"FFFFFFT", kRules, 5, step, .085f, .382f, .8f, .25f, {0, 0, .05f}};
    Growth growth = growByGrammar(grammar, random);
    setRadii(growth.branches, 1.0f);
    drawLimbs(canvas, growth.branches, wood);
    drawRoots(canvas, 4, 1.8f, .6f, wood, random);
    for (const Tuft& tuft : growth.tufts) {
        const float size = random.between(.8f, 1.2f);
        canvas.clump(tuft.at + Point{0, 0, .4f}, Point{2.1f, 2.1f, 1.1f} * size, .3f, leaves, random);
    }
}

// Each arm ends in a star of dagger leaves, and forks below it.
void drawJoshuaTree(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("palm_log", kWoodRank), leaves = canvas.paint("palm_leaves", kLeafRank);
    constexpr Rule kRules[] = {
        {'A', .6f, "F[/&FFFA]//[/&FFA]"},
        {'A', .4f, "F[/&FFA]/[/&FFFA]/[/&FFA]"},
    };
    const Grammar grammar = {"FA", kRules, 2, random.between(1.0f, 1.35f), .14f, .3f, .8f, .25f, {0, 0, .2f}};
    Growth growth = growByGrammar(grammar, random);
    setRadii(growth.branches, .8f);
    drawLimbs(canvas, growth.branches, wood);
    // Arms are a grammar's last branches: they have no child.
    for (const BranchNode& n : growth.branches) {
        if (n.tips != 1 || n.parent < 0) continue;
        const int x = roundToInt(n.at.x), y = roundToInt(n.at.y), z = roundToInt(n.at.z);
        canvas.set(x, y, z + 1, leaves);
        canvas.set(x, y, z + 2, leaves);
        for (int k = 0; k < 4; ++k) {
            const int dx = (k & 1) * (k - 2), dy = (1 - (k & 1)) * (k - 1);
            canvas.set(x + dx, y + dy, z + 1, leaves);
            canvas.set(x + dx, y + dy, z, leaves);
            if (random.unit() < .6f) canvas.set(x + 2 * dx, y + 2 * dy, z + 1, leaves);
        }
    }
}

// Low and open: twigs from one root, with small leaves at their ends.
void drawDryShrub(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("dead_log", kWoodRank), leaves = canvas.paint("olive_leaves", kLeafRank);
    constexpr Rule kRules[] = {
        {'S', 1.0f, "[/&&A]/[/&&A]/[/&&A]/[/A]"},
        {'A', .5f, "FFL"},
        {'A', .3f, "F^FFL"},
        {'A', .2f, "F^F"},
    };
    const Grammar grammar = {"S", kRules, 2, random.between(.8f, 1.1f), .085f, .24f, .8f, .3f, {}};
    Growth growth = growByGrammar(grammar, random);
    setRadii(growth.branches, .4f);
    drawLimbs(canvas, growth.branches, wood);
    for (const Tuft& tuft : growth.tufts) canvas.clump(tuft.at, {1.5f, 1.5f, 1.1f}, .35f, leaves, random);
}

}  // namespace terrane::gen::trees
