// Trees of dry and hot lands: acacia, baobab, palm.
#include "terrane/gen/generators/trees/branching.h"
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

}  // namespace terrane::gen::trees
