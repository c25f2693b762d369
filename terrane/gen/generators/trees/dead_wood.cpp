// Dead wood: snag, stump, uprooted tree.

#include "terrane/gen/generators/trees/branching.h"
#include "terrane/gen/generators/trees/kinds_internal.h"

namespace terrane::gen::trees {
namespace {

// Splinters: columns on the rim of a broken trunk, each of its own height.
void drawSplinters(Canvas& canvas, Point top, float radius, int highest, Canvas::Paint wood, Random& random) {
    const int reach = static_cast<int>(radius + 1.0f), mx = roundToInt(top.x), my = roundToInt(top.y);
    for (int y = my - reach; y <= my + reach; ++y) {
        for (int x = mx - reach; x <= mx + reach; ++x) {
            const Point d = {static_cast<float>(x) - top.x, static_cast<float>(y) - top.y, 0};
            if (lengthSquared(d) > radius * radius) continue;
            const int height = random.between(0, highest);
            for (int k = 0; k <= height; ++k) canvas.set(x, y, roundToInt(top.z) + k, wood);
        }
    }
}

// Moss on what is open to the sky, at most `highest` above the foot.
void drawMoss(Canvas& canvas, float share, int highest, Canvas::Paint wood, Canvas::Paint moss,
              Random& random) {
    for (int y = -kMaxShapeReach; y <= kMaxShapeReach; ++y) {
        for (int x = -kMaxShapeReach; x <= kMaxShapeReach; ++x) {
            int z = kMaxShapeZ;
            while (z > kMinShapeZ && canvas.at(x, y, z) == 0) --z;
            if (z > highest || canvas.at(x, y, z) != wood || random.unit() > share) continue;
            canvas.set(x, y, z, moss);
        }
    }
}

}  // namespace

// A trunk that died standing: the top is broken off, of the branches only stubs are left.
void drawSnag(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("dead_log", kWoodRank);
    const float height = random.between(8.0f, 15.0f), radius = random.between(1.0f, 1.5f);
    const Point top = aside(.3f, 1.5f, random) + Point{0, 0, height};
    canvas.limb(kRootEnd, top, radius, radius * .75f, wood);
    drawSplinters(canvas, top, radius * .75f, 4, wood, random);
    drawRoots(canvas, 5, radius + 1.6f, .7f, wood, random);
    const int stubs = random.between(3, 6);
    float turns = random.unit();
    for (int k = 0; k < stubs; ++k) {
        turns += .382f;
        const Point from = top * random.between(.35f, .9f);
        const Point out = heading(turns) * random.between(1.8f, 3.6f);
        canvas.limb(from, from + out + Point{0, 0, random.between(.4f, 1.8f)}, .5f, .4f, wood);
    }
}

void drawStump(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("oak_log", kWoodRank), moss = canvas.paint("moss", kWoodRank);
    const float radius = random.between(1.1f, 1.9f);
    const int height = random.between(0, 2);
    canvas.limb({0, 0, -2}, {0, 0, -1}, radius, radius, wood);
    const bool isBroken = random.unit() < .5f;  // else sawn or bitten off level
    for (int z = -1; z <= height; ++z) {
        for (int y = -2; y <= 2; ++y) {
            for (int x = -2; x <= 2; ++x) {
                if (lengthSquared({static_cast<float>(x), static_cast<float>(y), 0}) <= radius * radius)
                    canvas.set(x, y, z, wood);
            }
        }
    }
    if (isBroken) drawSplinters(canvas, {0, 0, static_cast<float>(height)}, radius, 2, wood, random);
    const int roots = random.between(4, 6);
    const float first = random.unit();
    for (int k = 0; k < roots; ++k) {
        const Point out = heading(turnsOf(k, roots, first, random));
        const float length = radius + random.between(1.2f, 2.8f);
        canvas.limb(out * (radius * .8f) + Point{0, 0, .6f}, out * length + Point{0, 0, -.6f}, .5f, .4f,
                    wood);
    }
    drawMoss(canvas, .3f, height + 2, wood, moss, random);
}

// Thrown by the wind: the plate of roots stands up with the earth that it tore out, the trunk lies behind it.
void drawUprootedTree(Canvas& canvas, Random& random) {
    const auto wood = canvas.paint("oak_log", kWoodRank), moss = canvas.paint("moss", kWoodRank),
               earth = canvas.paint("dirt", kWoodRank);
    const bool isAlongX = random.unit() < .5f;
    const float away = random.unit() < .5f ? 1.0f : -1.0f;
    const Point along = isAlongX ? Point{away, 0, 0} : Point{0, away, 0}, side = {along.y, along.x, 0};
    const float radius = random.between(2.6f, 3.6f), length = random.between(9.0f, 13.0f);
    canvas.limb({0, 0, -2}, {0, 0, 0}, .8f, .8f, earth);
    for (float u = -radius; u <= radius; u += .5f) {
        for (float v = -radius; v <= radius; v += .5f) {
            const float far = shared::detDivide(u * u + v * v, radius * radius);
            if (far > 1.0f || (far > .55f && random.unit() < .4f)) continue;
            const Point at = side * u + Point{0, 0, radius * .75f + v};
            canvas.set(roundToInt(at.x), roundToInt(at.y), roundToInt(at.z), earth);
        }
    }
    // Roots run over the plate and beyond its rim.
    const Point heart = {0, 0, radius * .75f};
    for (int k = 0; k < 7; ++k) {
        const Point way = heading(shared::detDivide(static_cast<float>(k), 7.0f));
        const float reach = radius * random.between(.9f, 1.5f);
        const Point end = heart + side * (way.x * reach) + Point{0, 0, way.y * reach} + along * -.8f;
        canvas.limb(heart, end, .5f, .4f, wood);
    }
    const Point end = along * length + Point{0, 0, .2f};
    canvas.limb(heart * .6f, end, 1.3f, .8f, wood);
    for (int k = 0; k < 4; ++k) {
        const float t = random.between(.55f, 1.0f), across = random.between(-2.6f, 2.6f);
        const Point from = heart * .6f + (end - heart * .6f) * t;
        canvas.limb(from, from + along * 1.4f + side * across + Point{0, 0, random.between(.6f, 2.6f)}, .4f,
                    .4f, wood);
    }
    drawMoss(canvas, .3f, 4, wood, moss, random);
}

}  // namespace terrane::gen::trees
