#include "terrane/gen/generators/landforms.h"
#include "terrane/gen/generators/ruins.h"
#include "terrane/gen/generators/wilderness.h"

// Places of wilderness that reward walking. The land is divided into squares, each with a point at which
// one kind of place may be: so places are far enough apart, and a column needs to look at one point alone.
// A place follows the ground of each column, since a column cannot read the height at the point. Its share,
// from slow noise, makes it smaller towards land where it does not belong.

namespace terrane::gen::wilderness {

namespace {

constexpr int kSquare = 512, kMargin = 72;  // blocks: no place reaches as far as the next square's

struct PlaceKind {
    Place place;
    float share;   // of the squares
    float radius;  // blocks in which nothing grows but its own plants
};
constexpr PlaceKind kPlaces[] = {{Place::Arch, 0.15f, 30.0f},     {Place::SeaArch, 0.14f, 0.0f},
                                 {Place::Sinkhole, 0.25f, 36.0f}, {Place::HotSprings, 0.22f, 44.0f},
                                 {Place::GiantTree, 0.1f, 40.0f}, {Place::Ruins, 0.14f, 22.0f}};

Bool isKind(Pass& p, const Fields& f, Place place) {
    return p.read(f.placeKind) == Int(static_cast<int>(place));
}

Float fromPlace(Pass& p, const Fields& f) {
    const Float x(p.read(f.placeX)), y(p.read(f.placeY));
    return sqrt(x * x + y * y);
}

// 0…1, by place and name.
Float chanceOf(Pass& p, const Fields& f, const char* name) {
    return p.random2D(name, p.x() + p.read(f.placeX), p.y() + p.read(f.placeY));
}

// Whether the column has the point itself.
Bool isPoint(Pass& p, const Fields& f) {
    const int step = p.step();
    const Int x = p.read(f.placeX), y = p.read(f.placeY);
    if (step == 1) return x == 0 && y == 0;
    return x >= -(step / 2) && x < step / 2 && y >= -(step / 2) && y < step / 2;
}

// Share: plains, where a place of wide ground can be.
Float flatLand(Pass& p, const Fields& f) {
    return smoothstep(0.3f, 0.1f, p.read(f.range)) * smoothstep(0.3f, 0.1f, p.read(f.table)) *
           smoothstep(0.02f, 0.0f, p.read(f.volcanic)) * smoothstep(0.02f, 0.06f, p.read(f.land));
}

// Share: away from streams, whose banks a place must not open.
Float besideStream(Pass& p, const Fields& f) {
    return smoothstep(24.0f, 60.0f, p.read(f.fromStream));
}

}  // namespace

void setPlace(Pass& p, const Fields& f) {
    const Int column = floorDivide(p.x(), kSquare), row = floorDivide(p.y(), kSquare);
    constexpr float kFree = kSquare - 2 * kMargin;
    const Int atX = column * kSquare + kMargin + Int(p.random2D("place x", column, row) * kFree);
    const Int atY = row * kSquare + kMargin + Int(p.random2D("place y", column, row) * kFree);
    const Float chance = p.random2D("kind of place", column, row);
    Int kind = -1;
    float below = 1;
    for (auto k = std::rbegin(kPlaces); k != std::rend(kPlaces); ++k) {
        kind = select(chance < below, Int(static_cast<int>(k->place)), kind);
        below -= k->share;
    }
    const Bool isGlade = max(abs(atX), abs(atY)) < 100;
    p.set(f.placeKind, select(isGlade, Int(-1), kind));
    p.set(f.placeX, atX - p.x());
    p.set(f.placeY, atY - p.y());
}

Float clearing(Pass& p, const Fields& f) {
    Float radius = 0.0f;
    for (const PlaceKind& k : kPlaces)
        if (k.radius > 0) radius = select(isKind(p, f, k.place), Float(k.radius), radius);
    return smoothstep(1.3f, 0.9f, fromPlace(p, f) / max(radius, Float(1.0f)));
}

namespace {

Float sinkholeShare(Pass& p, const Fields& f) {
    return smoothstep(0.3f, 0.5f, limestoneShare(p, f)) * flatLand(p, f) * besideStream(p, f);
}

Float sinkholeRadius(Pass& p, const Fields& f) {
    const Float rough = p.simplex2D("sinkhole walls", 10, {.5f, 1.0f});
    return chanceOf(p, f, "sinkhole size") * 14.0f + 17.0f + rough * 2.0f;
}

constexpr float kSinkholeReach = 60.0f;  // blocks

}  // namespace

Float withPlaces(Pass& p, const Fields& f, Float ground) {
    Var<Float> height = p.var(ground);
    const Float away = fromPlace(p, f);
    p.if_(isKind(p, f, Place::Sinkhole) && away < kSinkholeReach, [&] {
        const Float radius = sinkholeRadius(p, f);
        const Float share = smoothstep(0.05f, 0.3f, sinkholeShare(p, f));
        const Float hole = smoothstep(radius + 1.5f, radius - 1.5f, away) * share;
        const Float bottom = kSea - 16.0f + smoothstep(0.0f, radius, away) * 5.0f;
        // No gully cuts the rock that hangs over the water.
        const Float even =
            lerp(ground, p.read(f.base), smoothstep(kSinkholeReach, radius + 12.0f, away) * share);
        height = lerp(even, min(even, bottom), hole);
    });
    p.if_(isKind(p, f, Place::GiantTree) && away < 56.0f, [&] {
        const Float mound = smoothstep(52.0f, 6.0f, away);
        height = ground + mound * 11.0f * flatLand(p, f) * besideStream(p, f);
    });
    return height;
}

Float besideSinkhole(Pass& p, const Fields& f, float least) {
    Var<Float> beside = p.var(Float(kSinkholeReach));
    p.if_(isKind(p, f, Place::Sinkhole) && fromPlace(p, f) < kSinkholeReach && p.read(f.height) > kSea, [&] {
        beside = select(sinkholeShare(p, f) > least, fromPlace(p, f) - sinkholeRadius(p, f),
                        Float(kSinkholeReach));
    });
    return beside;
}

namespace {

constexpr float kStep = 3.0f, kSprings = 40.0f;  // blocks: height of terraces, radius

// A dome of terraces: pools with rims, whose water is that of their own terrace.
struct Springs {
    Float share, part;  // 0…1: of land for springs, from the middle to the edge
    Float terrace;      // the terrace's number, with a fraction
};

Springs springsAt(Pass& p, const Fields& f, Float ground) {
    const Float volcanic = p.read(f.volcanic);
    const Float slopes = smoothstep(0.005f, 0.03f, volcanic) * smoothstep(0.5f, 0.35f, volcanic);
    const Float plains = smoothstep(0.3f, 0.5f, p.perlin2D("hot rock", 512, {.4f, 1.0f})) * flatLand(p, f);
    const Float share = max(slopes, plains) * besideStream(p, f) * smoothstep(0.02f, 0.05f, p.read(f.land));
    const Float lobes = p.simplex2D("spring lobes", 12, {.4f, 1.0f});
    const Float part = clamp(fromPlace(p, f) * (1.0f / kSprings), 0.0f, 1.0f);
    const Float dome = (1.0f - part * part) * 13.0f;
    return {share, part + lobes * 0.1f, (ground + dome * share + lobes * 1.5f) * (1.0f / kStep)};
}

}  // namespace

void addSprings(Pass& p, const Fields& f, Var<Float>& height, Var<Int>& water, Var<Float>& spring) {
    p.if_(isKind(p, f, Place::HotSprings) && fromPlace(p, f) < kSprings, [&] {
        const Springs s = springsAt(p, f, p.read(f.base));
        // Beyond the pools a rim as high as their terrace goes all around.
        const Bool isPool = s.share > 0.9f && s.part<0.82f, isRim = s.share> 0.5f && s.part < 1.0f;
        const Float part = s.terrace - floor(s.terrace);
        const Float top = select(isPool, floor(s.terrace), floor(s.terrace + 0.45f)) * kStep;
        const Bool isWater = isPool && part > 0.24f;
        height = select(isRim, select(isWater, top - 0.5f, top + 0.5f), static_cast<Float>(height));
        water = select(isWater, Int(top), select(isRim, Int(kSeaZ), static_cast<Int>(water)));
        spring = select(isRim, part + 1.0f, Float(0.0f));
    });
}

Block springGround(Pass& p, Float spring, Block ground) {
    const Float part = spring - 1.0f;
    const Block terrace = multiSelect({{part < 0.12f, p.block("terracotta")},
                                       {part < 0.3f, p.block("sandstone")},
                                       {part > 0.8f, p.block("clay")}},
                                      p.block("limestone"));
    return select(spring > 0.0f, terrace, ground);
}

Span archAt(Pass& p, const Fields& f) {
    Var<Int> low = p.var(Int(kNoSpan)), high = p.var(Int(-kNoSpan));
    const Float away = fromPlace(p, f);
    const Bool isOnLand = isKind(p, f, Place::Arch), isInSea = isKind(p, f, Place::SeaArch);
    p.if_((isOnLand || isInSea) && away < 64.0f, [&] {
        const Float land = p.read(f.land);
        const Float rocky = smoothstep(0.15f, 0.0f, p.read(f.moisture)) * 0.6f + 0.4f;
        const Float onLand = flatLand(p, f) * rocky;
        // Wide bands, since the land's value has the roughness of the shore.
        const Float inSea = smoothstep(-0.09f, -0.04f, land) * smoothstep(0.06f, 0.03f, land);
        const Float share = smoothstep(0.3f, 0.5f, select(isOnLand, onLand, inSea));
        const Float size = chanceOf(p, f, "arch size"), turn = chanceOf(p, f, "arch direction") * 3.1416f;
        const Float x(-p.read(f.placeX)), y(-p.read(f.placeY));
        const Float bend = p.simplex2D("arch bends", 24, {.4f, 1.0f}) * 2.5f;
        const Float along = x * cos(turn) + y * sin(turn), across = y * cos(turn) - x * sin(turn) + bend;
        const Float rise = (size * 20.0f + 15.0f) * share, reach = size * 16.0f + 15.0f;
        const Float part = along / reach;
        const Float middle = (1.0f - part * part) * rise;
        const Float halfWidth = abs(part) * 2.5f + size * 2.0f + 3.5f;
        const Float inside = clamp(1.0f - across * across / (halfWidth * halfWidth), 0.0f, 1.0f);
        const Float slope = part * rise * 2.0f / reach;
        const Float thick = sqrt(inside) * (size * 1.5f + 2.6f) * sqrt(slope * slope + 1.0f) *
                            (p.simplex2D("arch rocks", 7, {.6f, 1.0f}) * 0.16f + 1.0f);
        const Float ground = select(isOnLand, p.read(f.base), Float(kSea - 3.0f));
        // Columns beside each other meet, however steep the arch is.
        const Bool isHere = thick > abs(slope) * 0.9f + 0.9f && share > 0.3f;
        low = select(isHere, Int(floor(ground + middle - thick)), static_cast<Int>(low));
        high = select(isHere, Int(floor(ground + middle + thick)), static_cast<Int>(high));
    });
    return {low, high};
}

void archesPass(Pass& p, const Fields& f) {
    const Span arch = archAt(p, f);
    p.set(f.archLow, arch.low);
    p.set(f.archHigh, arch.high);
    if (p.step() > kMaxNotchStep) return;
    Span notch = notchAt(p, f);
    // The walls of sinkholes hang over the water.
    const Float beside = besideSinkhole(p, f, 0.3f) * (1.0f / 8.0f);
    const Bool isBelow =
        beside >= -0.3f && beside < 1.0f && p.read(f.height) > kSea + 9.0f && p.read(f.rocky) <= 0.0f;
    // At the wall itself the height is that of the hole's edge: there the roof follows the land around.
    const Float level = select(beside < 0.25f, p.read(f.base), min(p.read(f.base), p.read(f.height)));
    const Float roof = lerp(level - 5.0f, Float(kSea + 2.0f), clamp(beside * beside, 0.0f, 1.0f));
    notch.low = select(isBelow, Int(kSeaZ - 7), notch.low);
    notch.high = select(isBelow, Int(floor(roof)), notch.high);
    p.set(f.notchLow, notch.low);
    p.set(f.notchHigh, notch.high);
}

Int placeShape(Pass& p, const Fields& f, Bool canStand) {
    const Int hash = Int(chanceOf(p, f, "place shape") * 16777216.0f);
    const Bool isHere = isPoint(p, f) && canStand;
    const Bool isMild = p.read(f.cold) > -0.25f && p.read(f.moisture) > -0.42f;
    return multiSelect({{isHere && isMild && isKind(p, f, Place::GiantTree),
                         trees::shapeOf(of(f.plants.kinds, trees::Kind::GiantTree), hash)},
                        {isHere && isKind(p, f, Place::Ruins), ruins::shapeOf(f.ruins, hash)}},
                       Int(-1));
}

}  // namespace terrane::gen::wilderness
