// Finds the first cell that stops a ray. C++ and GLSL get the same cell, face and bits of t.
//
// GLSL includes it after declaring the words: `readonly buffer … { uint rayWords[]; };`
#ifndef TERRANE_SHARED_RAY_CAST_H
#define TERRANE_SHARED_RAY_CAST_H

#include "terrane/shared/language.h"
#include "terrane/shared/ray_scene.h"
#include "terrane/shared/ray_step.h"

SHARED_BEGIN

#ifdef __cplusplus
using RayWords = const uint*;
[[gnu::always_inline]] inline uint rayWord(RayWords rays, uint at) {
    return rays[at];
}
[[gnu::always_inline]] inline int bitCount(uint bits) {
    return std::popcount(bits);
}
#else
#define RayWords uint  // of no meaning: there is one buffer
uint rayWord(RayWords rays, uint at) {
    return rayWords[at];
}
#endif

SHARED_ALWAYS_INLINE uint rayHeader(RayWords rays, int level, uint word) {
    return rayWord(rays, kRayFirstLevel + kRayLevelWords * uint(level) + word);
}

// Where the entry of a tile is; 0 outside of the window.
SHARED_ALWAYS_INLINE uint rayEntryAt(RayWords rays, int level, int x, int y) {
    uint bits = rayWord(rays, kRaySideBits);
    uint side = 1u << bits;
    if (uint(x) - rayHeader(rays, level, kRayLowX) >= side) return 0u;
    if (uint(y) - rayHeader(rays, level, kRayLowY) >= side) return 0u;
    uint number = (uint(y) & (side - 1u)) << bits | (uint(x) & (side - 1u));
    return rayHeader(rays, level, kRayGrid) + kRayEntryWords * number;
}

// Finds the tile at a place, looking first at `level`. Where the ray is above all of a tile, or above all
// tiles that divide one, it passes them as one box: the search begins one level higher after each box, so
// that rays through the sky take few steps.
SHARED_ALWAYS_INLINE RayColumn rayColumnAt(RayWords rays, SHARED_REF(Ray) ray, ivec4 cell, int level) {
    RayColumn column;
    int x = cell.x ^ ray.mirror.x, y = cell.y ^ ray.mirror.y, z = cell.z ^ ray.mirror.z;
    bool isDown = ray.mirror.z != 0;
    int bottom = int(rayWord(rays, kRayBottom)), top = int(rayWord(rays, kRayTop));
    int levels = int(rayWord(rays, kRayLevelCount));
    // Up, while neither the tile nor its parts are in the scene.
    int asked = level < levels ? level : levels - 1;
    uint at = rayEntryAt(rays, asked, x >> (4 + asked), y >> (4 + asked));
    uint what = at == 0u ? kRayNothing : rayWord(rays, at);
    while (what == kRayNothing && asked < levels - 1) {
        ++asked;
        at = rayEntryAt(rays, asked, x >> (4 + asked), y >> (4 + asked));
        what = at == 0u ? kRayNothing : rayWord(rays, at);
    }
    bool isGone = at == 0u || (isDown ? z < bottom : z >= top);
    column.heights = at == 0u ? 0u : rayWord(rays, at + 1u);
    // Down, to the tile itself, or to a place that no tile covers.
    while (what == kRayDivided && z < rayTopOf(column.heights)) {
        --asked;
        at = rayEntryAt(rays, asked, x >> (4 + asked), y >> (4 + asked));
        what = at == 0u ? kRayNothing : rayWord(rays, at);
        column.heights = at == 0u ? 0u : rayWord(rays, at + 1u);
    }
    column.level = asked;
    column.words = what;
    bool isCovered = what != kRayNothing;
    bool isAbove = isCovered && z >= rayTopOf(column.heights);
    int shift = 4 + asked;
    int endZ = z < bottom ? bottom : top;
    if (isDown) endZ = isAbove ? -rayTopOf(column.heights) : -bottom;
    column.end = ivec4(rayPlaneBehind(cell.x, shift), rayPlaneBehind(cell.y, shift), endZ, 0);
    column.state = isGone ? kRayGone : isAbove || !isCovered || z < bottom ? kRaySkip : kRayInside;
    return column;
}

// The first cell at `place` or behind it that stops the ray. `place` becomes that cell.
SHARED_ALWAYS_INLINE RayHit castRayFrom(RayWords rays, SHARED_REF(Ray) ray, SHARED_INOUT(RayPlace) place) {
    RayHit hit;
    hit.face = kRayMiss;
    hit.unused = 0u;
    bool isStopped = false;
    while (!isStopped && place.t <= ray.start.w) {
        RayColumn column = rayColumnAt(rays, ray, place.cell, place.level);
        if (column.state == kRayGone) break;
        place.level = column.level;
        if (column.state == kRaySkip) {
            rayLeaveBox(ray, place, column.end);
            ++place.level;
            continue;
        }
        int level = column.level, bottom = int(rayWord(rays, kRayBottom)), top = rayTopOf(column.heights);
        int lowest = rayLowestSectionOf(column.heights);
        // From box to box inside the tile.
        for (;;) {
            ivec4 cell = place.cell;
            int z = cell.z ^ ray.mirror.z;
            int section = (z >> 4) > lowest ? z >> 4 : lowest;
            uint node = rayWord(rays, column.words + uint(section - lowest));
            int shift = 4;  // of the empty box around the place
            isStopped = node == kRayFull;
            if (node > kRayFull) {
                int x = (cell.x ^ ray.mirror.x) >> level, y = (cell.y ^ ray.mirror.y) >> level;
                uint child = uint(x >> 2 & 3) | uint(y >> 2 & 3) << 2 | uint(z >> 2 & 3) << 4;
                uint part = node + (child >> 5) * kRayHalfWords, bit = child & 31u;
                uint bits = rayWord(rays, part + kRayAny);
                shift = 2;
                if ((bits >> bit & 1u) != 0u) {
                    uint partial = rayWord(rays, part + kRayPartial);
                    isStopped = (partial >> bit & 1u) == 0u;
                    uint leaf = rayWord(rays, part + kRayLeaves) +
                                kRayLeafWords * uint(bitCount(partial & ((1u << bit) - 1u)));
                    if (!isStopped) {
                        child = uint(x & 3) | uint(y & 3) << 2 | uint(z & 3) << 4;
                        bit = child & 31u;
                        bits = rayWord(rays, leaf + (child >> 5));
                        isStopped = (bits >> bit & 1u) != 0u;
                        shift = 0;
                    }
                }
                // Twice as wide where the eight of an octant are empty.
                if ((bits >> (bit & 0xAu) & kRayOctant) == 0u) shift += 1;
            }
            if (isStopped) break;
            rayLeaveBox(ray, place, rayBoxEnd(cell, level + shift, shift));
            if (!(place.t <= ray.start.w)) break;
            if (((place.cell.x ^ cell.x) | (place.cell.y ^ cell.y)) >> (4 + level) != 0) break;
            z = place.cell.z ^ ray.mirror.z;
            if (z < bottom || z >= top) break;
        }
        if (!isStopped) ++place.level;
    }
    if (isStopped && place.t <= ray.start.w) {
        hit.cell =
            ivec4(place.cell.x ^ ray.mirror.x, place.cell.y ^ ray.mirror.y, place.cell.z ^ ray.mirror.z, 0);
        int mirror = place.axis == 0 ? ray.mirror.x : place.axis == 1 ? ray.mirror.y : ray.mirror.z;
        hit.face = place.axis == kRayBegins ? kRayFaceNone : uint(2 * place.axis - mirror);
        hit.t = place.t;
        hit.level = place.level;
    }
    return hit;
}

SHARED_ALWAYS_INLINE RayHit castRay(RayWords rays, SHARED_REF(Ray) ray) {
    RayPlace place = rayBegin(ray);
    return castRayFrom(rays, ray, place);
}

SHARED_END
#endif
