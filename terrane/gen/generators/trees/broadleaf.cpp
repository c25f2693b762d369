// Oak, birch, willow, dead trees, bushes: crowns grown by space colonization (branching.h).

#include "terrane/gen/generators/trees/branching.h"
#include "terrane/gen/generators/trees/kinds_internal.h"

namespace terrane::gen::trees {

void drawOak(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("oak_log", kWoodRank), leaves = canvas.paint("oak_leaves", kLeafRank);
    Branches branches;
    const float height = random.between(3.0f, 4.5f), width = random.between(3.8f, 4.8f);
    growTrunk(branches, height, random.between(0.0f, 1.0f), random);
    const Point top = branches.back().at;
    const Crown crown = {top + Point{0, 0, random.between(2.2f, 3.0f)},
                         {width, width * random.between(.85f, 1.1f), random.between(3.0f, 3.8f)},
                         0.45f,
                         height - 0.5f};
    colonize(branches, pointsIn(crown, 70, random), {9, 1.8f, 1, {0, 0, .15f}, .25f}, random);
    setRadii(branches, 0.7f);
    drawLimbs(canvas, branches, wood, 2);
    drawFoliage(canvas, branches, {{1.7f, 1.7f, 1.3f}, .35f, 1}, leaves, random);
}

void drawOldOak(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("oak_log", kWoodRank), leaves = canvas.paint("oak_leaves", kLeafRank);
    Branches branches;
    const float height = random.between(6.0f, 8.0f), width = random.between(12.0f, 14.0f);
    growTrunk(branches, height, random.between(0.5f, 1.5f), random);
    const Point top = branches.back().at;
    const Crown crown = {top + Point{0, 0, random.between(4.0f, 5.5f)},
                         {width, width * random.between(.85f, 1.0f), random.between(7.0f, 8.5f)},
                         0.5f,
                         height - 1.0f};
    colonize(branches, pointsIn(crown, 260, random), {16, 2.6f, 1.4f, {0, 0, .1f}, .35f}, random);
    setRadii(branches, 2.1f);
    drawLimbs(canvas, branches, wood, 2);
    drawRoots(canvas, 6, 4.0f, 1.1f, wood, random);
    drawFoliage(canvas, branches, {{2.3f, 2.3f, 1.6f}, .3f, 1}, leaves, random);
}

// A tree that stands alone, as high and as wide as a shape can be.
void drawGiantTree(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("oak_log", kWoodRank), leaves = canvas.paint("oak_leaves", kLeafRank);
    Branches branches;
    const float height = random.between(17.0f, 20.0f);
    growTrunk(branches, height, random.between(0.5f, 2.0f), random);
    const Point top = branches.back().at;
    const Crown crown = {
        top + Point{0, 0, 10.0f}, {13.5f, 13.5f, random.between(14.0f, 15.5f)}, 0.45f, height - 4.0f};
    colonize(branches, pointsIn(crown, 420, random), {22, 2.6f, 1.5f, {0, 0, .12f}, .3f}, random);
    setRadii(branches, 3.9f);
    drawLimbs(canvas, branches, wood, 2);
    drawRoots(canvas, 9, 8.0f, 1.9f, wood, random);
    drawFoliage(canvas, branches, {{2.4f, 2.4f, 1.7f}, .35f, 1}, leaves, random);
}

void drawBirch(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("birch_log", kWoodRank), leaves = canvas.paint("birch_leaves", kLeafRank);
    Branches branches;
    const float height = random.between(9.0f, 13.0f), width = random.between(2.2f, 2.9f);
    growTrunk(branches, height, random.between(0.3f, 1.4f), random);
    const Point top = branches.back().at;
    const Crown crown = {{top.x * .8f, top.y * .8f, height * 0.72f},
                         {width, width, height * random.between(.36f, .42f)},
                         0.4f,
                         height * 0.35f};
    colonize(branches, pointsIn(crown, 55, random), {5, 1.5f, 1, {0, 0, .45f}, .2f}, random);
    setRadii(branches, 0.6f);
    drawLimbs(canvas, branches, wood, 2);
    drawFoliage(canvas, branches, {{1.35f, 1.35f, 1.5f}, .3f, 1}, leaves, random);
}

void drawWillow(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("willow_log", kWoodRank),
               leaves = canvas.paint("willow_leaves", kLeafRank);
    Branches branches;
    const float height = random.between(4.5f, 6.0f), width = random.between(5.5f, 7.0f);
    growTrunk(branches, height, random.between(.5f, 1.5f), random);
    const Crown crown = {branches.back().at + Point{0, 0, 2.5f}, {width, width, 3.5f}, 0.4f, height};
    colonize(branches, pointsIn(crown, 90, random), {10, 2.2f, 1, {0, 0, .1f}, .25f}, random);
    setRadii(branches, 1.15f);
    drawLimbs(canvas, branches, wood, 2);
    drawRoots(canvas, 4, 2.2f, .6f, wood, random);
    drawFoliage(canvas, branches, {{1.6f, 1.6f, 1.1f}, .5f, 1}, leaves, random);
    // Curtains: below leaves that have nothing under them, longer the farther out they hang.
    for (int y = -kMaxShapeReach; y <= kMaxShapeReach; ++y) {
        for (int x = -kMaxShapeReach; x <= kMaxShapeReach; ++x) {
            int z = 1;
            while (z < kMaxShapeZ && canvas.at(x, y, z) == 0) ++z;
            if (canvas.at(x, y, z) != leaves || random.unit() > 0.5f) continue;
            const int length = random.between(2, static_cast<int>(height) + 1);
            for (int k = 1; k <= length && z - k >= 1; ++k) canvas.set(x, y, z - k, leaves);
        }
    }
}

void drawDeadTree(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("dead_log", kWoodRank);
    Branches branches;
    const float height = random.between(4.0f, 7.0f), width = random.between(3.5f, 5.0f);
    growTrunk(branches, height, random.between(.5f, 1.5f), random);
    const Crown crown = {branches.back().at + Point{0, 0, 2.0f}, {width, width, 4.5f}, 0.6f, height * .7f};
    colonize(branches, pointsIn(crown, random.between(11, 16), random), {12, 1.5f, 1, {0, 0, .3f}, .35f},
             random);
    setRadii(branches, 0.7f);
    drawLimbs(canvas, branches, wood);
    drawRoots(canvas, 3, 1.5f, .5f, wood, random);
}

void drawBush(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("oak_log", kWoodRank), leaves = canvas.paint("oak_leaves", kLeafRank);
    const float size = random.between(.75f, 1.3f);
    canvas.limb({0, 0, -1}, {0, 0, 0}, .4f, .4f, wood);
    const int stems = random.between(3, 5);
    for (int k = 0; k < stems; ++k) {
        const Point way = heading(random.unit());
        const Point out = way * (size * random.between(.3f, 1.5f));
        const Point at = out + Point{0, 0, size * random.between(0.2f, 1.6f)};
        canvas.clump(at, Point{1.5f, 1.5f, 1.2f} * size, .35f, leaves, random);
    }
    canvas.set(0, 0, 1, leaves);
}

}  // namespace terrane::gen::trees
