// Shapes low on the ground: boulders, fallen logs, giant mushrooms.

#include "terrane/gen/generators/trees/canvas.h"
#include "terrane/gen/generators/trees/kinds_internal.h"

namespace terrane::gen::trees {

void drawBoulder(Canvas& canvas, Random& random) {
    const auto stone = canvas.paint("stone", kWoodRank), moss = canvas.paint("mossy_stone", kWoodRank);
    const float size = random.between(1.2f, 3.2f);
    const int lumps = random.between(2, 4);
    for (int k = 0; k < lumps; ++k) {
        const Point way = heading(random.unit());
        const Point at = way * (size * random.between(0.0f, .7f));
        const Point radii =
            Point{random.between(.7f, 1.2f), random.between(.7f, 1.2f), random.between(.6f, .95f)} * size;
        canvas.clump(at + Point{0, 0, random.between(-.2f, .8f)}, radii, .8f, stone, random);
    }
    canvas.clump({0, 0, -.5f}, {size, size, 1.5f}, 1.0f, stone, random);
    // Moss lies on what is open to the sky, more on one side.
    const Point shade = heading(random.unit());
    for (int y = -kMaxShapeReach; y <= kMaxShapeReach; ++y) {
        for (int x = -kMaxShapeReach; x <= kMaxShapeReach; ++x) {
            int z = kMaxShapeZ;
            while (z > kMinShapeZ && canvas.at(x, y, z) == 0) --z;
            const float side = static_cast<float>(x) * shade.x + static_cast<float>(y) * shade.y;
            if (canvas.at(x, y, z) == stone && random.unit() < .45f + .2f * side) canvas.set(x, y, z, moss);
        }
    }
}

void drawFallenLog(Canvas& canvas, Random& random) {
    const bool isBirch = random.unit() < .35f;
    const auto wood = canvas.paint(isBirch ? "birch_log" : "oak_log", kWoodRank);
    const auto moss = canvas.paint("moss", kWoodRank);
    const int length = random.between(5, 9);
    const bool isAlongX = random.unit() < .5f;
    const int from = -length / 2;
    for (int k = from; k < from + length; ++k) {
        canvas.set(isAlongX ? k : 0, isAlongX ? 0 : k, 0, wood);
        // On uneven ground it lies in the earth rather than above it.
        canvas.set(isAlongX ? k : 0, isAlongX ? 0 : k, -1, wood);
        if (random.unit() < .35f) canvas.set(isAlongX ? k : 0, isAlongX ? 0 : k, 1, moss);
    }
    const int end = from + length, side = random.unit() < .5f ? 1 : -1;
    canvas.set(isAlongX ? end : 0, isAlongX ? 0 : end, 0, wood);
    canvas.set(isAlongX ? end : side, isAlongX ? side : end, 0, wood);
    canvas.set(isAlongX ? end : 0, isAlongX ? 0 : end, 1, wood);
}

void drawGiantMushroom(Canvas& canvas, Random& random) {
    const auto stem = canvas.paint("mushroom_stem", kWoodRank), cap = canvas.paint("mushroom_cap", kWoodRank);
    const int height = random.between(4, 9);
    const float radius = random.between(2.2f, 4.0f), rise = radius * random.between(.55f, .8f);
    const Point way = heading(random.unit());
    const Point lean = way * random.between(0.0f, 1.2f);
    const Point top = lean + Point{0, 0, static_cast<float>(height)};
    canvas.limb({0, 0, -2}, {0, 0, 0}, .5f, .5f, stem);
    canvas.limb({0, 0, 0}, top, .5f, .5f, stem);
    // A shell, open from below.
    const int reach = static_cast<int>(radius + 1.5f), mx = roundToInt(top.x), my = roundToInt(top.y);
    for (int z = 0; z <= static_cast<int>(rise + 1.0f); ++z) {
        for (int y = my - reach; y <= my + reach; ++y) {
            for (int x = mx - reach; x <= mx + reach; ++x) {
                const float dx = static_cast<float>(x) - top.x, dy = static_cast<float>(y) - top.y;
                const float dz = static_cast<float>(z);
                const auto inside = [&](float r, float h) {
                    return shared::detDivide(dx * dx + dy * dy, r * r) + shared::detDivide(dz * dz, h * h) <=
                           1.0f;
                };
                if (inside(radius, rise) && !inside(radius - 1.1f, rise - 1.0f))
                    canvas.set(x, y, height + z, cap);
            }
        }
    }
    for (int z = height; z <= height + static_cast<int>(rise); ++z) {
        if (canvas.at(mx, my, z) == 0) canvas.set(mx, my, z, stem);
    }
}

}  // namespace terrane::gen::trees
