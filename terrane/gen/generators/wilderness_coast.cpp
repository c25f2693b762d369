#include "terrane/gen/generators/wilderness.h"

// Cliffs of wilderness that the sea undercuts: stacks before the coast, notches and caves at its level.

namespace terrane::gen::wilderness {

namespace {

// Share: how rocky and high the coast is here.
Float cliffShare(Pass& p, const Fields& f) {
    return max(smoothstep(0.1f, 0.5f, p.perlin2D("cliffs", 128, {.3f, .6f, 1.0f})),
               smoothstep(0.1f, 0.4f, p.read(f.range)));
}

struct Stack {
    Float away, radius;  // blocks from its middle; 0 where there is none
    Float top;           // z
};

Stack stackAt(Pass& p, const Fields& f) {
    const Voronoi2D at = p.voronoi2D("stacks", 52, 1);
    const Int x = p.x() + at.offset.x, y = p.y() + at.offset.y;
    const Float size = p.random2D("stack size", x, y), land = p.read(f.land);
    const Float near = smoothstep(-0.03f, -0.018f, land) * smoothstep(-0.002f, -0.006f, land);
    const Float share = near * smoothstep(0.2f, 0.5f, cliffShare(p, f));
    const Bool isStack = p.random2D("is stack", x, y) < 0.3f;
    const Float rough = p.simplex2D("stack sides", 6, {.5f, 1.0f}) * 0.9f;
    return {
        at.distance,
        select(isStack, (size * 5.0f + 4.0f) * smoothstep(0.1f, 0.4f, share) + rough * share, Float(0.0f)),
        kSea + 7.0f + size * 24.0f - at.distance * 0.25f + rough};
}

}  // namespace

Float withStacks(Pass& p, const Fields& f, Float ground) {
    Var<Float> height = p.var(ground);
    const Float land = p.read(f.land);
    p.if_(land < -0.002f && land > -0.03f, [&] {
        const Stack stack = stackAt(p, f);
        height = select(stack.away < stack.radius, max(ground, stack.top), ground);
    });
    return height;
}

Span notchAt(Pass& p, const Fields& f) {
    const Float land = p.read(f.land), surface = p.read(f.height);
    Var<Int> low = p.var(Int(kNoSpan)), high = p.var(Int(-kNoSpan));
    const Bool isHigh = surface > kSea + 8.0f && p.read(f.wet) <= 0.0f;
    p.if_(isHigh && land > 0.0f && land < 0.006f, [&] {
        const Float caves = smoothstep(0.2f, 0.5f, p.simplex2D("sea caves", 20, {.4f, 1.0f}));
        const Float deep = caves * 0.0045f + 0.0012f;
        const Float part = clamp(land / deep, 0.0f, 1.0f);
        const Float roof = kSea + 1.0f + (1.0f - part * part) * (caves * 8.0f + 4.0f);
        const Bool isOpen = land < deep;
        low = select(isOpen, Int(kSeaZ - 3), static_cast<Int>(low));
        high = select(isOpen, Int(floor(min(roof, surface - 4.0f))), static_cast<Int>(high));
    });
    p.if_(isHigh && land < -0.002f && land > -0.03f, [&] {
        const Stack stack = stackAt(p, f);
        const Bool isEdge = stack.away < stack.radius && stack.away > stack.radius - 1.7f;
        low = select(isEdge, Int(kSeaZ - 6), static_cast<Int>(low));
        high = select(isEdge, Int(kSeaZ + 4), static_cast<Int>(high));
    });
    return {low, high};
}

}  // namespace terrane::gen::wilderness
