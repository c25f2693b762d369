// Conifers. Most have one trunk to the top, and branches in whorls around it, as an L-system with one axis
// writes them (P. Prusinkiewicz, A. Lindenmayer, The Algorithmic Beauty of Plants, 1990, 2.3).
#include <algorithm>

#include "terrane/gen/generators/trees/branching.h"
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

// Flat boughs in tiers, and a spire.
void drawFir(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("spruce_log", kWoodRank), leaves = canvas.paint("fir_leaves", kLeafRank);
    const float height = random.between(22.0f, 30.0f);
    drawStem(canvas, height - 5, 1.0f, wood);
    const Whorls whorls = {2.0f, height - 1.5f, 2.2f, height * random.between(.19f, .22f), .7f, .12f,
                           9,    1.3f,          .04f};
    drawWhorls(canvas, whorls, leaves, random);
    drawTop(canvas, roundToInt(height) - 4, 5, leaves);
}

void drawYoungFir(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("spruce_log", kWoodRank), leaves = canvas.paint("fir_leaves", kLeafRank);
    const float height = random.between(4.0f, 8.0f);
    drawStem(canvas, height - 2, .4f, wood);
    drawWhorls(canvas, {0.6f, height - 1, 1.9f, 1.2f + height * .28f, .5f, .1f, 8, .7f, .05f}, leaves,
               random);
    drawTop(canvas, roundToInt(height) - 1, 2, leaves);
}

void drawYoungSpruce(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("spruce_log", kWoodRank),
               leaves = canvas.paint("spruce_leaves", kLeafRank);
    const float height = random.between(2.5f, 6.0f);
    drawStem(canvas, height - 1, .4f, wood);
    drawWhorls(canvas, {0.4f, height - .5f, 1.2f, height * .4f, .5f, .45f, 6, .7f, .1f}, leaves, random);
    drawTop(canvas, roundToInt(height) - 1, 2, leaves);
}

// A pillar: the foot spreads, the crown begins at a third of the height and ends round.
void drawSequoia(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("pine_log", kWoodRank), leaves = canvas.paint("pine_leaves", kLeafRank);
    const float height = random.between(43.0f, 46.5f), radius = random.between(2.9f, 3.5f);
    canvas.limb({0, 0, -3}, {0, 0, 3}, radius * 1.35f, radius, wood);
    canvas.limb({0, 0, 3}, {0, 0, height * .55f}, radius, radius * .7f, wood);
    canvas.limb({0, 0, height * .55f}, {0, 0, height - 3}, radius * .7f, .6f, wood);
    drawRoots(canvas, 7, radius + 2.4f, 1.3f, wood, random);
    float turns = random.unit();
    for (float z = height * .34f; z < height - 2; z += .85f) {
        const float t = shared::detDivide(z - height * .34f, height * .66f);
        turns += .382f;
        // Boughs leave the trunk thick, sag, and carry their leaves in a round head.
        const float reach = (6.6f - 4.6f * t * t) * random.between(.75f, 1.15f);
        const Point out = heading(turns);
        const Point knee = out * (reach * .6f) + Point{0, 0, z - reach * .22f};
        const Point end = out * reach + Point{0, 0, z - reach * .08f};
        canvas.limb({0, 0, z}, knee, .8f, .5f, wood);
        canvas.limb(knee, end, .4f, .4f, wood);
        const float size = random.between(.85f, 1.15f) * (1.0f - .25f * t);
        canvas.clump(end, Point{2.6f, 2.6f, 1.7f} * size, .3f, leaves, random);
        canvas.clump(knee + Point{0, 0, .8f}, Point{1.9f, 1.9f, 1.3f} * size, .3f, leaves, random);
    }
    canvas.clump({0, 0, height - 1.5f}, {2.4f, 2.4f, 2.6f}, .4f, leaves, random);
}

// Flat plates of leaves on long level boughs; the top is flat too.
void drawCedar(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("spruce_log", kWoodRank), leaves = canvas.paint("fir_leaves", kLeafRank);
    const float height = random.between(15.0f, 20.0f);
    const Point lean = aside(.5f, 1.5f, random);
    const Point top = lean + Point{0, 0, height};
    canvas.limb(kRootEnd, {0, 0, height * .4f}, 1.5f, 1.2f, wood);
    canvas.limb({0, 0, height * .4f}, top, 1.2f, .5f, wood);
    drawRoots(canvas, 5, 2.6f, .8f, wood, random);
    float turns = random.unit();
    const int tiers = 5;
    for (int tier = 0; tier < tiers; ++tier) {
        const float t = shared::detDivide(static_cast<float>(tier), static_cast<float>(tiers - 1));
        const float z = height * (.34f + .64f * t);
        const int boughs = tier == tiers - 1 ? 4 : 3;
        turns += .19f;
        for (int k = 0; k < boughs; ++k) {
            const float turn = turnsOf(k, boughs, turns, random);
            const float reach = (9.5f - 4.5f * t) * random.between(.7f, 1.1f);
            const float rise = random.between(.2f, 1.2f);
            const Point from = lean * t + Point{0, 0, z - 1};
            const Point end = lean * t + heading(turn) * reach + Point{0, 0, z + rise};
            canvas.limb(from, end, .7f, .4f, wood);
            for (const float along : {.55f, 1.0f}) {
                const float size = random.between(.85f, 1.15f) * (along < 1 ? .8f : 1.0f);
                const Point at = from + (end - from) * along + Point{0, 0, .6f};
                canvas.clump(at, Point{3.0f, 3.0f, .75f} * size, .35f, leaves, random);
            }
        }
    }
    canvas.clump(top + Point{0, 0, .5f}, {2.8f, 2.8f, .8f}, .4f, leaves, random);
}

// An umbrella: a bare trunk, boughs that rise like ribs, one flat dome of leaves.
void drawStonePine(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("pine_log", kWoodRank), leaves = canvas.paint("pine_leaves", kLeafRank);
    const float height = random.between(11.0f, 15.0f), radius = random.between(5.5f, 7.5f);
    const Point top = aside(.3f, 2.0f, random) + Point{0, 0, height};
    const Point fork = top * .5f;
    canvas.limb(kRootEnd, {0, 0, 0}, .8f, .8f, wood);
    canvas.limb({0, 0, 0}, fork, .8f, .7f, wood);
    drawRoots(canvas, 3, 1.6f, .5f, wood, random);
    const int ribs = random.between(5, 6);
    const float first = random.unit();
    for (int k = 0; k < ribs; ++k) {
        const Point out = heading(turnsOf(k, ribs, first, random));
        const float reach = radius * random.between(.6f, .8f);
        const Point end = Point{top.x, top.y, height - .5f} + out * reach;
        const Point knee = fork + (end - fork) * .45f + Point{0, 0, .6f};
        canvas.limb(fork, knee, .5f, .4f, wood);
        canvas.limb(knee, end, .4f, .4f, wood);
        canvas.clump(end + Point{0, 0, .5f}, {radius * .42f, radius * .42f, 1.2f}, .45f, leaves, random);
    }
    canvas.limb(fork, top, .5f, .4f, wood);
    canvas.clump(top + Point{0, 0, .9f}, {radius * .62f, radius * .62f, 1.6f}, .6f, leaves, random);
}

namespace {

// Leaves on the lee side of a point only, in a wedge that rises away from the wind.
void drawFlag(Canvas& canvas, Point from, float length, float rise, Canvas::Paint leaves, Random& random) {
    for (float s = 0; s <= length; s += .8f) {
        const float t = shared::detDivide(s, length);
        const float wide = 1.0f + 1.1f * t * (1.6f - t);
        const Point at = from + Point{s, random.between(-.4f, .4f), rise * t};
        canvas.clump(at, {1.2f, wide, .75f}, .45f, leaves, random);
    }
}

}  // namespace

// A pine at the tree line. The wind comes from -x everywhere: half of them lie along the ground, the others
// stand and have boughs only on the lee side.
void drawKrummholz(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("dead_log", kWoodRank), leaves = canvas.paint("pine_leaves", kLeafRank);
    const bool stands = random.unit() < .5f;
    const float height = stands ? random.between(4.5f, 7.5f) : random.between(1.4f, 2.4f);
    const float drift = stands ? random.between(1.0f, 2.2f) : random.between(4.0f, 6.5f);
    const Point knee = {drift * .3f, random.between(-.6f, .6f), height * (stands ? .5f : .75f)};
    const Point top = {drift, random.between(-.8f, .8f), height};
    canvas.limb({0, 0, -2}, {0, 0, 0}, .5f, .5f, wood);
    canvas.limb({0, 0, 0}, knee, .5f, .5f, wood);
    canvas.limb(knee, top, .5f, .4f, wood);
    if (stands) {
        for (float z = height * .35f; z < height; z += 1.4f) {
            const float t = shared::detDivide(z, height);
            const Point from = z < knee.z
                                   ? knee * shared::detDivide(z, knee.z)
                                   : knee + (top - knee) * shared::detDivide(z - knee.z, top.z - knee.z);
            drawFlag(canvas, from + Point{.8f, 0, .2f}, (4.6f - 2.8f * t) * random.between(.8f, 1.2f), .3f,
                     leaves, random);
        }
        // What grew into the wind is dead.
        canvas.limb(knee, knee + Point{-1.6f, .3f, .4f}, .4f, .4f, wood);
        canvas.clump(top + Point{.4f, 0, .3f}, {1.0f, .9f, .9f}, .5f, leaves, random);
    } else {
        drawFlag(canvas, knee + Point{-.3f, 0, .4f}, drift * .9f, .9f, leaves, random);
        drawFlag(canvas, knee + Point{.8f, 1.5f, -.4f}, drift * .7f, .7f, leaves, random);
        drawFlag(canvas, knee + Point{.8f, -1.5f, -.4f}, drift * .7f, .7f, leaves, random);
        canvas.limb({0, 0, 0}, {-1.4f, .6f, 1.2f}, .4f, .4f, wood);
    }
}

// Several pointed flames of scaly leaves above a twisted stem that is bare on one side.
void drawJuniper(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("acacia_log", kWoodRank), leaves = canvas.paint("fir_leaves", kLeafRank);
    const int flames = random.between(3, 5);
    const float first = random.unit();
    canvas.limb(kRootEnd, {0, 0, 1}, .8f, .7f, wood);
    for (int k = 0; k < flames; ++k) {
        const Point out = heading(turnsOf(k, flames, first, random));
        const float height = random.between(4.0f, 7.5f), reach = random.between(.9f, 1.9f);
        const Point low = out * reach + Point{0, 0, 1.8f}, high = out * (reach * 1.5f) + Point{0, 0, height};
        canvas.limb({0, 0, .5f}, low, .5f, .4f, wood);
        canvas.limb(low, low + (high - low) * .25f, .4f, .4f, wood);
        for (float t = 0; t <= 1; t += .15f) {
            const float radius = t < .3f ? 1.2f + t : 1.75f - 1.25f * t;
            canvas.clump(low + (high - low) * t, {radius, radius, 1.2f}, .55f, leaves, random);
        }
        canvas.set(roundToInt(high.x), roundToInt(high.y), roundToInt(high.z) + 1, leaves);
    }
    const Point bare = heading(first + shared::detDivide(.5f, static_cast<float>(flames)));
    canvas.limb({0, 0, .5f}, bare * 1.8f + Point{0, 0, 2.6f}, .4f, .4f, wood);
}

}  // namespace terrane::gen::trees
