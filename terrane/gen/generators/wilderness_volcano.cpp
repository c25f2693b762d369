#include "terrane/gen/generators/wilderness.h"
#include "terrane/gen/language/compounds.h"

// Volcanoes of wilderness: the cone, and what lava and rain made of its flanks.

namespace terrane::gen::wilderness {

// A cone with a crater around the point of a wide cell.
Volcano volcanoAt(Pass& p) {
    constexpr int kCell = 6144;
    constexpr float kChance = 0.3f;
    const Voronoi2D cell = p.voronoi2D("volcanoes", kCell, 1);
    const Int x = p.x() + cell.offset.x, y = p.y() + cell.offset.y;
    const Bool isVolcano = p.random2D("is volcano", x, y) < kChance;
    const Float size = p.random2D("volcano size", x, y);
    const Float radius = size * 500.0f + 900.0f, rise = size * 450.0f + 600.0f, crater = size * 60.0f + 90.0f;
    const Float away = cell.distance / radius;
    // Of ten craters four have a lake and three are full of lava.
    const Float inCrater = p.random2D("in the crater", x, y);
    constexpr float kFoot = 45.0f;  // blocks below the sea
    Var<Float> height = p.var(Float(0.0f)), share = p.var(Float(0.0f));
    Var<Int> lake = p.var(Int(-kNoSpan));
    p.if_(isVolcano && away < 1.45f, [&] {
        // Its foot reaches farther in some directions; the crater is round.
        const Float uneven = p.simplex2D("lava flows", 256, {.12f, .4f, 1.0f}) * 0.24f + 1.0f;
        const Float along = away * lerp(Float(1.0f), uneven, smoothstep(0.15f, 0.5f, away));
        const Float outside = clamp(1.0f - along, 0.0f, 1.0f);
        // A cone whose sides get steeper up to the rim.
        const Float rim = clamp(1.0f - crater / radius, 0.0f, 1.0f), up = min(outside, rim);
        const Float inside = smoothstep(crater * 0.95f, crater * 0.55f, cell.distance);
        height = up * (up * 0.75f + 0.25f) * rise - inside * rise * 0.12f;
        share = outside;
        const Float level = kSea - kFoot + rim * (rim * 0.75f + 0.25f) * rise - rise * 0.06f;
        lake = select(inCrater < 0.7f && cell.distance < crater, Int(level), static_cast<Int>(lake));
    });
    return {kSea - kFoot + height, height, share, lake, inCrater < 0.3f, Float(cell.offset.x),
            Float(cell.offset.y)};
}

namespace {

// Blocks that a small cone beside the great one stands above the ground: one in some of the cells of a noise.
Float cinderCones(Pass& p, Float share) {
    const Voronoi2D cell = p.voronoi2D("cinder cones", 460, 1);
    const Int x = p.x() + cell.offset.x, y = p.y() + cell.offset.y;
    const Bool isCone = p.random2D("is cinder cone", x, y) < 0.45f;
    const Float size = p.random2D("cinder cone size", x, y) * 45.0f + 45.0f;
    const Float rough = p.simplex2D("cinder cone sides", 24, {.4f, 1.0f}) * 5.0f;
    const Float outside = clamp(size - cell.distance + rough, 0.0f, size * 0.82f);
    const Float crater = smoothstep(size * 0.2f, 0.0f, cell.distance) * size * 0.22f;
    const Float onFlank = smoothstep(0.04f, 0.12f, share) * smoothstep(0.62f, 0.45f, share);
    return select(isCone, (outside * 0.72f - crater) * onFlank, Float(0.0f));
}

}  // namespace

Float flanksOf(Pass& p, const Volcano& volcano) {
    const Float share = volcano.share;
    // Tongues of lava run down: waves around the cone, broken by noise, with steep edges and flat tops.
    const Float inverse =
        1.0f / max(sqrt(volcano.toX * volcano.toX + volcano.toY * volcano.toY), Float(1.0f));
    const Vec2 around = {-volcano.toY * inverse, volcano.toX * inverse};
    const Float broken = p.simplex2D("lava tongues", 64, {.2f, .5f, 1.0f});
    const Float old = p.stripes2D("old lava tongues", 420, around).cosine + broken * 0.5f;
    const Float young = p.stripes2D("young lava tongues", 230, around).cosine + broken * 0.5f;
    const Float foot = smoothstep(0.0f, 0.06f, share) * smoothstep(0.7f, 0.4f, share);
    const Float tongues = smoothstep(0.2f, 0.7f, old) * 15.0f + smoothstep(0.55f, 0.95f, young) * 10.0f;
    return tongues * foot + cinderCones(p, share);
}

Float barrancos(Pass& p, const Fields& f, Vec2 slope) {
    const Float share = p.read(f.volcanic);
    const Float strength = smoothstep(0.12f, 0.3f, share) * smoothstep(0.9f, 0.6f, share) *
                           smoothstep(kSea + 2.0f, kSea + 40.0f, p.read(f.base));
    return erode(p, "barrancos", slope, strength,
                 {.size = 256, .octaves = 2, .depth = 0.17f, .fullSlope = 0.7f, .gain = 0.55f})
        .height;
}

}  // namespace terrane::gen::wilderness
