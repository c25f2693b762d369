// Plants of wet and hot lands.

#include "terrane/gen/generators/trees/branching.h"
#include "terrane/gen/generators/trees/kinds_internal.h"

namespace terrane::gen::trees {
namespace {

// A plank root: a thin wall that runs out from the trunk and falls in a curve.
void drawButtress(Canvas& canvas, float turns, float length, float height, Canvas::Paint wood) {
    const Point out = heading(turns);
    for (float s = 0; s <= length; s += .5f) {
        const float t = 1.0f - shared::detDivide(s, length);
        const Point at = out * (s + 1.5f);
        const int x = roundToInt(at.x), y = roundToInt(at.y);
        for (int z = -3; z <= roundToInt(height * t * t); ++z) canvas.set(x, y, z, wood);
    }
}

// Lianas: strings of leaves below the crown, `longest` blocks or to the ground.
void drawLianas(Canvas& canvas, float share, int longest, Canvas::Paint leaves, Random& random) {
    for (int y = -kMaxShapeReach; y <= kMaxShapeReach; ++y) {
        for (int x = -kMaxShapeReach; x <= kMaxShapeReach; ++x) {
            int z = 1;
            while (z < kMaxShapeZ && canvas.at(x, y, z) == 0) ++z;
            if (z == 1 || canvas.at(x, y, z) != leaves || random.unit() > share) continue;
            const int length = random.between(3, longest);
            for (int k = 1; k <= length && z - k >= 1; ++k) canvas.set(x, y, z - k, leaves);
        }
    }
}

// A leaf with leaflets on both sides: it rises by `rise` blocks, then bends down by `fall`.
struct Arch {
    float length, rise, fall, width;
};

void drawArch(Canvas& canvas, Point from, float turns, const Arch& arch, Canvas::Paint leaves) {
    const Point out = heading(turns), side = {-out.y, out.x, 0};
    int last = roundToInt(from.z);
    for (float s = 0; s <= arch.length; s += .5f) {
        const float t = shared::detDivide(s, arch.length);
        const Point at = from + out * s + Point{0, 0, arch.rise * t - arch.fall * t * t};
        const int z = roundToInt(at.z);
        canvas.set(roundToInt(at.x), roundToInt(at.y), z, leaves);
        canvas.set(roundToInt(at.x), roundToInt(at.y), last, leaves);  // steep parts stay joined by faces
        last = z;
        const float half = arch.width * (t < .4f ? t * 2.5f : 1.65f - 1.6f * t);
        for (float w = .5f; w <= half; w += .5f) {
            for (const float across : {-w, w}) {
                const Point leaf = at + side * across;
                canvas.set(roundToInt(leaf.x), roundToInt(leaf.y), z, leaves);
            }
        }
    }
}

}  // namespace

// Higher than the forest around it: plank roots, a bare pale column, an umbrella of level boughs.
void drawKapok(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("pale_log", kWoodRank), leaves = canvas.paint("kapok_leaves", kLeafRank);
    const float height = random.between(34.0f, 38.0f), width = random.between(11.5f, 13.0f);
    const int planks = random.between(5, 7);
    const float first = random.unit();
    for (int k = 0; k < planks; ++k) {
        const float turns = turnsOf(k, planks, first, random), length = random.between(3.5f, 6.0f);
        drawButtress(canvas, turns, length, random.between(8.0f, 13.0f), wood);
    }
    canvas.limb({0, 0, -3}, {0, 0, height * .7f}, 2.0f, 1.6f, wood);
    Branches branches;
    addLine(branches, -1, {0, 0, height * .7f}, {0, 0, height});
    const Crown crown = {{0, 0, height + 1.5f}, {width, width, 6.5f}, .25f, height - 3.5f};
    colonize(branches, pointsIn(crown, 200, random), {16, 2.6f, 1.4f, {0, 0, .05f}, .3f}, random);
    setRadii(branches, 1.8f);
    drawLimbs(canvas, branches, wood, 2);
    drawFoliage(canvas, branches, {{2.3f, 2.3f, 1.1f}, .3f, 1}, leaves, random);
    canvas.clump({0, 0, height + 2}, {5.0f, 5.0f, 1.6f}, .3f, leaves, random);
    drawLianas(canvas, .035f, 9, leaves, random);
}

// A strangler: a trunk of many stems, and a wide crown that stands on roots it has let down.
void drawFig(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("willow_log", kWoodRank), leaves = canvas.paint("kapok_leaves", kLeafRank);
    const float height = random.between(8.0f, 10.0f), width = random.between(10.0f, 12.5f);
    const int stems = random.between(5, 7);
    const float first = random.unit();
    for (int k = 0; k < stems; ++k) {
        const float turns = turnsOf(k, stems, first, random);
        const Point foot = heading(turns) * random.between(1.2f, 2.6f) + Point{0, 0, -2};
        const Point top = heading(turns + .15f) * random.between(.3f, 1.0f) + Point{0, 0, height};
        canvas.limb(foot, top, .9f, .6f, wood);
    }
    canvas.limb(kRootEnd, {0, 0, height}, .9f, .9f, wood);
    Branches branches;
    addLine(branches, -1, {0, 0, height * .6f}, {0, 0, height});
    const Crown crown = {{0, 0, height + 1.5f}, {width, width, 5.5f}, .5f, height - 1.5f};
    colonize(branches, pointsIn(crown, 170, random), {14, 2.6f, 1.4f, {0, 0, .05f}, .3f}, random);
    setRadii(branches, 1.6f);
    drawLimbs(canvas, branches, wood, 2);
    for (const BranchNode& n : branches) {
        if (n.tips < 2 || lengthSquared({n.at.x, n.at.y, 0}) < 14.0f || random.unit() > .14f) continue;
        canvas.limb(n.at, {n.at.x, n.at.y, -2}, .4f, .4f, wood);
    }
    drawFoliage(canvas, branches, {{2.3f, 2.3f, 1.2f}, .3f, 1}, leaves, random);
    drawLianas(canvas, .08f, 5, leaves, random);
}

// Stands on arched roots above mud and shallow water; the trunk begins above them.
void drawMangrove(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("acacia_log", kWoodRank), leaves = canvas.paint("kapok_leaves", kLeafRank);
    const float height = random.between(7.0f, 9.0f);
    const int roots = random.between(6, 8);
    const float first = random.unit();
    canvas.limb({0, 0, -4}, {0, 0, 3}, .4f, .4f, wood);
    for (int k = 0; k < roots; ++k) {
        const Point out = heading(turnsOf(k, roots, first, random));
        const float reach = random.between(3.6f, 6.0f), from = random.between(2.8f, 4.5f);
        const Point knee = out * (reach * .6f) + Point{0, 0, from - .3f};
        canvas.limb({0, 0, from}, knee, .4f, .4f, wood);
        canvas.limb(knee, out * (reach * .92f) + Point{0, 0, from - 2.4f}, .4f, .4f, wood);
        canvas.limb(out * (reach * .92f) + Point{0, 0, from - 2.4f}, out * reach + Point{0, 0, -4}, .4f, .4f,
                    wood);
    }
    Branches branches;
    const Point top = aside(.3f, 1.4f, random) + Point{0, 0, height};
    addLine(branches, -1, {0, 0, 3}, top);
    const Crown crown = {top + Point{0, 0, 1.0f}, {5.6f, 5.6f, 2.8f}, .45f, height - 1.0f};
    colonize(branches, pointsIn(crown, 60, random), {8, 2.0f, 1, {0, 0, .1f}, .3f}, random);
    setRadii(branches, .8f);
    drawLimbs(canvas, branches, wood, 2);
    drawFoliage(canvas, branches, {{1.8f, 1.8f, 1.1f}, .35f, 1}, leaves, random);
}

// A dark stem and one umbrella of long arched leaves, with young ones rolled up in its middle.
void drawTreeFern(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("spruce_log", kWoodRank), leaves = canvas.paint("palm_leaves", kLeafRank);
    const float height = random.between(3.0f, 7.0f), first = random.unit();
    const Point top = aside(0.0f, 1.0f, random) + Point{0, 0, height};
    canvas.limb(kRootEnd, top, .5f, .5f, wood);
    const int fronds = random.between(7, 9);
    for (int k = 0; k < fronds; ++k) {
        const float turns = turnsOf(k, fronds, first, random), length = random.between(4.2f, 5.6f);
        drawArch(canvas, top + Point{0, 0, 1}, turns, {length, 3.4f, 5.6f, .7f}, leaves);
    }
    for (int k = 1; k <= 2; ++k)
        canvas.set(roundToInt(top.x), roundToInt(top.y), roundToInt(top.z) + k, leaves);
}

// Leaves from the ground, without a stem.
void drawDwarfPalm(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("palm_log", kWoodRank), leaves = canvas.paint("palm_leaves", kLeafRank);
    canvas.limb(kRootEnd, {0, 0, 0}, .4f, .4f, wood);
    const int fronds = random.between(6, 8);
    const float first = random.unit();
    for (int k = 0; k < fronds; ++k) {
        const float turns = turnsOf(k, fronds, first, random), length = random.between(2.6f, 4.2f);
        drawArch(canvas, {0, 0, 1}, turns, {length, random.between(4.6f, 7.4f), 4.6f, .3f}, leaves);
    }
}

// A clump of canes that bend outward, bare below.
void drawBamboo(Canvas& canvas, Random& random) {
    const auto cane = canvas.paint("bamboo", kWoodRank), leaves = canvas.paint("willow_leaves", kLeafRank);
    const int canes = random.between(7, 11);
    float turns = random.unit();
    for (int k = 0; k < canes; ++k) {
        turns += .382f;
        const float height = random.between(8.0f, 15.0f);
        // Canes stand in a spiral, the first one on the foot.
        const float far = 1.15f * shared::detSqrt(static_cast<float>(k));
        const Point out = heading(turns), foot = out * far;
        const Point knee = foot + out * (height * .06f) + Point{0, 0, height * .65f};
        const Point tip = foot + out * (height * random.between(.2f, .34f)) + Point{0, 0, height};
        canvas.limb(foot + Point{0, 0, -2}, foot, .4f, .4f, cane);
        canvas.limb(foot, knee, .4f, .4f, cane);
        canvas.limb(knee, tip, .4f, .4f, cane);
        for (float t = .1f; t <= 1.0f; t += .3f) {
            const Point at = knee + (tip - knee) * t;
            canvas.clump(at, Point{2.0f, 2.0f, 1.2f} * random.between(.8f, 1.1f), .6f, leaves, random);
        }
    }
}

// Undergrowth in deep shade: broad dark leaves down to the ground.
void drawThicket(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("willow_log", kWoodRank), leaves = canvas.paint("kapok_leaves", kLeafRank);
    canvas.limb({0, 0, -1}, {0, 0, 0}, .4f, .4f, wood);
    const int stems = random.between(3, 5);
    const float first = random.unit();
    for (int k = 0; k < stems; ++k) {
        const float turns = turnsOf(k, stems, first, random), reach = random.between(1.0f, 2.6f);
        const Point end = heading(turns) * reach + Point{0, 0, random.between(1.0f, 2.4f)};
        canvas.limb({0, 0, 0}, end * .6f, .4f, .4f, wood);
        canvas.clump(end, {1.5f, 1.5f, 1.2f}, .4f, leaves, random);
        canvas.clump(end * .5f, {1.0f, 1.0f, .7f}, .35f, leaves, random);
    }
}

}  // namespace terrane::gen::trees
