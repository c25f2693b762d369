// Spruce, pine, larch, cypress: one trunk to the top, and branches in whorls around it, as an L-system with
// one axis writes them (P. Prusinkiewicz, A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, 2.3).
#include <algorithm>

#include "terrane/gen/generators/trees/canvas.h"
#include "terrane/gen/generators/trees/kinds_internal.h"

namespace terrane::gen::trees {
namespace {

struct Whorls {
    float from = 2, to = 15;  // heights
    float spacing = 2;        // from whorl to whorl
    float lowest = 4;         // length of the lowest branches; at `to` it is `highest`
    float highest = .8f;
    float droop = .25f;  // blocks down for each block out
    float branches = 6;  // in a whorl
    float width = .9f;   // of the leaves beside a branch, at its thickest
    float gaps = .15f;   // share of leaves that are missing
};

// Leaves beside a branch: broad near its middle, pointed at its end.
void drawSpray(Canvas& canvas, Point from, Point along, const Whorls& w, Canvas::Paint leaves,
               Random& random) {
    const float length = lengthOf(along);
    const Point out = normalized(along), side = {-out.y, out.x, 0};
    const int steps = static_cast<int>(length * 1.5f) + 1;
    for (int k = 0; k <= steps; ++k) {
        const float t = shared::detDivide(static_cast<float>(k), static_cast<float>(steps));
        const float half = w.width * (t < .35f ? .5f + t * 1.43f : 1.0f - (t - .35f) * 1.3f);
        const Point at = from + along * t;
        for (float s = -half; s <= half + .01f; s += .5f) {
            const Point leaf = at + side * s;
            if (random.unit() < w.gaps) continue;
            canvas.set(roundToInt(leaf.x), roundToInt(leaf.y), roundToInt(leaf.z), leaves);
        }
        canvas.set(roundToInt(at.x), roundToInt(at.y), roundToInt(at.z), leaves);
    }
}

void drawWhorls(Canvas& canvas, const Whorls& w, Canvas::Paint leaves, Random& random) {
    float turns = random.unit();
    for (float z = w.from; z <= w.to; z += w.spacing) {
        const float t = shared::detDivide(z - w.from, w.to - w.from);
        const int count = std::max(3, roundToInt(w.branches * (1.0f - .35f * t)));
        turns += 0.137f;  // so that branches do not lie above each other
        for (int k = 0; k < count; ++k) {
            const float length = (w.lowest + (w.highest - w.lowest) * t) * random.between(.78f, 1.12f);
            const float turn = turns + (static_cast<float>(k) + random.between(-.2f, .2f)) *
                                           shared::detReciprocal(static_cast<float>(count));
            const Point along = heading(turn) * length + Point{0, 0, -w.droop * length};
            drawSpray(canvas, {0, 0, z + random.between(-.3f, .3f)}, along, w, leaves, random);
        }
    }
}

void drawStem(Canvas& canvas, float height, float radius, Canvas::Paint wood) {
    canvas.limb({0, 0, -2}, {0, 0, height}, radius, .4f, wood);
}

void drawTop(Canvas& canvas, int z, int length, Canvas::Paint leaves) {
    for (int k = 0; k < length; ++k) canvas.set(0, 0, z + k, leaves);
    for (int n = 0; n < 4; ++n) canvas.set((n & 1) * (n - 2), (1 - (n & 1)) * (n - 1), z, leaves);
}

}  // namespace

void drawSpruce(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("spruce_log", kWoodRank),
               leaves = canvas.paint("spruce_leaves", kLeafRank);
    const float height = random.between(13.0f, 21.0f);
    drawStem(canvas, height - 2, height > 17.0f ? .8f : .6f, wood);
    const Whorls whorls = {2.5f, height - 1, 1.6f, height * random.between(.22f, .27f), .7f, .42f,
                           7,    1.0f,       .1f};
    drawWhorls(canvas, whorls, leaves, random);
    drawTop(canvas, roundToInt(height) - 2, 4, leaves);
}

void drawPine(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("pine_log", kWoodRank), leaves = canvas.paint("pine_leaves", kLeafRank);
    const float height = random.between(11.0f, 17.0f), lean = random.between(.3f, 2.0f);
    const Point top = heading(random.unit()) * lean + Point{0, 0, height};
    const Point aside = heading(random.unit());
    const Point bend = aside * random.between(.2f, .9f) + top * .5f;
    canvas.limb({0, 0, -2}, {0, 0, 0}, .6f, .6f, wood);
    canvas.limb({0, 0, 0}, bend, .6f, .5f, wood);
    canvas.limb(bend, top, .5f, .4f, wood);
    const int pads = random.between(4, 6);
    float turns = random.unit();
    for (int k = 0; k < pads; ++k) {
        const float t = shared::detDivide(static_cast<float>(k), static_cast<float>(pads));
        turns += .382f;  // the golden angle
        const Point from = bend + (top - bend) * (.35f + .6f * t);
        const float reach = random.between(2.4f, 3.8f) * (1.0f - .35f * t), rise = random.between(.8f, 1.8f);
        const Point out = heading(turns) * reach + Point{0, 0, rise};
        canvas.limb(from, from + out, .4f, .4f, wood);
        canvas.clump(from + out + Point{0, 0, .5f}, Point{2.5f, 2.5f, 1.2f} * random.between(.8f, 1.1f), .25f,
                     leaves, random);
    }
    canvas.clump(top + Point{0, 0, .6f}, {2.6f, 2.6f, 1.5f}, .25f, leaves, random);
    // A dead stump of a branch on the bare part.
    const Point stump = bend * .7f;
    canvas.limb(stump, stump + heading(turns + .5f) * 1.6f, .4f, .4f, wood);
}

void drawLarch(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("pine_log", kWoodRank), leaves = canvas.paint("pine_leaves", kLeafRank);
    const float height = random.between(13.0f, 18.0f);
    drawStem(canvas, height - 1, .6f, wood);
    const Whorls whorls = {4.0f, height - 1, 2.1f, height * random.between(.17f, .21f), .8f, .1f,
                           5,    .55f,       .2f};
    drawWhorls(canvas, whorls, leaves, random);
    drawTop(canvas, roundToInt(height) - 1, 3, leaves);
}

void drawCypress(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("spruce_log", kWoodRank),
               leaves = canvas.paint("spruce_leaves", kLeafRank);
    const int height = random.between(11, 18);
    const float width = random.between(1.5f, 2.1f);
    drawStem(canvas, static_cast<float>(height) * .6f, .6f, wood);
    for (int z = 1; z <= height; ++z) {
        const float t = shared::detDivide(static_cast<float>(z), static_cast<float>(height));
        const float shape = t < .3f ? .65f + t * 1.15f : 1.0f - (t - .3f) * (t - .3f) * 1.25f;
        const float radius = std::max(.45f, width * shape * random.between(.92f, 1.12f));
        const Point middle = {random.between(-.25f, .25f), random.between(-.25f, .25f),
                              static_cast<float>(z)};
        canvas.clump(middle, {radius, radius, .9f}, .6f, leaves, random);
        canvas.set(0, 0, z, leaves);
    }
    canvas.set(0, 0, height + 1, leaves);
}

}  // namespace terrane::gen::trees
