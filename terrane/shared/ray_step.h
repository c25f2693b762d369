// How a ray goes from cell to cell: exactly, so that C++ and GLSL visit the same cells, and so that a step
// over many empty cells ends in the cell that single steps reach.
//
// A ray meets the planes between cells. The one at distance n along an axis is met at
//     t(n) = (n − start) · inverse        one subtraction and one product, each rounded once.
// Rounding keeps order: t grows with n. A cell is left through the plane of the smallest t; if two are equal,
// through that of the first axis. All cells beside a plane compute the same t for it, so nothing is passed
// between two cells, and where a ray is after a plane follows from that plane's t alone: on each other axis
// it has passed those planes that come before. That is what rayCellAfter() finds, whatever was skipped.
//
// Coordinates are mirrored: on axes along which a ray goes toward negative numbers, cell c is ~c = −1 − c. So
// every ray goes toward positive numbers, and shifts by powers of two still find the same blocks of cells.
#ifndef TERRANE_SHARED_RAY_STEP_H
#define TERRANE_SHARED_RAY_STEP_H

#include "terrane/shared/det_math.h"
#include "terrane/shared/language.h"

#ifdef __cplusplus
#include <glm/common.hpp>
#endif

SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
#endif

struct Ray {
    ivec4 cell;    // where it begins, mirrored, in blocks
    ivec4 mirror;  // -1 on axes along which it goes toward negative numbers, else 0: cell ^ mirror is in the
                   // world
    vec4 start;    // in that cell, 0 to 1, mirrored; w: the t at which the ray ends
    vec4 direction;  // mirrored: positive
    vec4 inverse;    // 1 / direction
};

// A cell on the way of a ray.
struct RayPlace {
    ivec4 cell;  // mirrored
    float t;     // at which it was entered
    int axis;    // across which it was entered, kRayBegins for the first cell
    int level;   // of the last tile that was looked at (ray_cast.h)
    uint unused;
};
const int kRayBegins = 3;

// Where a ray ends.
struct RayHit {
    ivec4 cell;  // the block; of a cell of a higher level the first block that the ray enters
    uint face;  // through which it enters: 2 · axis + (it goes toward positive numbers ? 0 : 1), or one below
    float t;
    int level;  // of the tile
    uint unused;
};
const uint kRayFaceNone = 6u;  // the ray begins in a cell that stops it
const uint kRayMiss = 7u;      // nothing stops it before its end; the rest has no meaning

// Directions have no smaller components: the inverse of 0 would be infinite, and infinity times 0 no number.
const float kRayMinDirection = 1.0f / 1048576.0f;

// `cell`: the block where the ray begins; `inCell`: where in it, 0 to 1 with both ends, so that a ray may
// begin on the face of a cell. `direction`: of any length, which is the unit of 1/t. `end`: the largest t.
SHARED_ALWAYS_INLINE Ray makeRay(ivec4 cell, vec4 inCell, vec4 direction, float end) {
    Ray ray;
    ray.mirror =
        ivec4(direction.x < 0.0f ? -1 : 0, direction.y < 0.0f ? -1 : 0, direction.z < 0.0f ? -1 : 0, 0);
    ray.cell = ivec4(cell.x ^ ray.mirror.x, cell.y ^ ray.mirror.y, cell.z ^ ray.mirror.z, 0);
    SHARED_PRECISE vec4 opposite = vec4(1.0f) - inCell;
    ray.start = vec4(direction.x < 0.0f ? opposite.x : inCell.x, direction.y < 0.0f ? opposite.y : inCell.y,
                     direction.z < 0.0f ? opposite.z : inCell.z, end);
    vec4 along =
        vec4(direction.x < 0.0f ? -direction.x : direction.x, direction.y < 0.0f ? -direction.y : direction.y,
             direction.z < 0.0f ? -direction.z : direction.z, 0.0f);
    ray.direction = vec4(along.x > kRayMinDirection ? along.x : kRayMinDirection,
                         along.y > kRayMinDirection ? along.y : kRayMinDirection,
                         along.z > kRayMinDirection ? along.z : kRayMinDirection, 0.0f);
    ray.inverse = vec4(detReciprocal(ray.direction.x), detReciprocal(ray.direction.y),
                       detReciprocal(ray.direction.z), 0.0f);
    return ray;
}

SHARED_ALWAYS_INLINE RayPlace rayBegin(SHARED_REF(Ray) ray) {
    RayPlace place;
    place.cell = ray.cell;
    place.t = 0.0f;
    place.axis = kRayBegins;
    place.level = 0;
    place.unused = 0u;
    return place;
}

// The t of the plane at `distance` from the low side of the first cell, along one axis.
SHARED_ALWAYS_INLINE float rayPlaneT(int distance, float start, float inverse) {
    SHARED_PRECISE float ahead = float(distance) - start;
    SHARED_PRECISE float t = ahead * inverse;
    return t;
}

// A position computed as start + t · direction is off by less than this share of the distance, plus 1:
// - t is off by at most 5 roundings of 2^-24 (two units in the last place for the inverse, and one rounding
//   each for the difference and the product), the position by 2 more, and comparisons by the same;
// - that is below 16 · 2^-24.
// So it lies in the right cell unless a plane is nearer than that.
const float kRayUncertainty = 1.0f / 1048576.0f;

// The cell along an axis after a plane of another axis was passed at `t`: the last one whose own plane comes
// before. `comesFirst`: whether a plane of this axis with an equal t comes before that plane. Cells are
// counted from the first one of the ray; the answer is in lowEnd.x … lowEnd.y − 1. `along`: the ray's start,
// direction and inverse on this axis.
SHARED_ALWAYS_INLINE int rayCellAfter(float t, bool comesFirst, ivec2 lowEnd, vec4 along) {
    float position = along.x + t * along.y;
    int at = int(position);
    float fromMiddle = position - float(at) - 0.5f;
    if (abs(fromMiddle) + kRayUncertainty * (position + 1.0f) > 0.5f) {
        at = at < lowEnd.x ? lowEnd.x : at >= lowEnd.y ? lowEnd.y - 1 : at;
        for (; at < lowEnd.y - 1; ++at) {
            float next = rayPlaneT(at + 1, along.x, along.z);
            if (!(next < t || (comesFirst && next == t))) break;
        }
        for (; at > lowEnd.x; --at) {
            float own = rayPlaneT(at, along.x, along.z);
            if (own < t || (comesFirst && own == t)) break;
        }
    }
    return at;
}

// From one cell to another, and back. The ends of the numbers meet: a ray may leave the world.
SHARED_ALWAYS_INLINE int rayDistance(int from, int to) {
    return int(uint(to) - uint(from));
}
SHARED_ALWAYS_INLINE int rayCellAt(int from, int distance) {
    return int(uint(from) + uint(distance));
}

// The planes where the box of 2^bits cells ends that has a cell in it.
SHARED_ALWAYS_INLINE int rayPlaneBehind(int cell, int bits) {
    return int((uint(cell >> bits) + 1u) << bits);
}
SHARED_ALWAYS_INLINE ivec4 rayBoxEnd(ivec4 cell, int bitsXY, int bitsZ) {
    return ivec4(rayPlaneBehind(cell.x, bitsXY), rayPlaneBehind(cell.y, bitsXY),
                 rayPlaneBehind(cell.z, bitsZ), 0);
}

// Leaves a box of cells that are passed without a look, and enters the cell behind it. `end`: the planes
// where the box ends, mirrored, each beyond the cell of the place. Branches are faster here than selections:
// the next box is looked up while the CPU still compares.
SHARED_ALWAYS_INLINE void rayLeaveBox(SHARED_REF(Ray) ray, SHARED_INOUT(RayPlace) place, ivec4 end) {
    vec4 alongX = vec4(ray.start.x, ray.direction.x, ray.inverse.x, 0.0f);
    vec4 alongY = vec4(ray.start.y, ray.direction.y, ray.inverse.y, 0.0f);
    vec4 alongZ = vec4(ray.start.z, ray.direction.z, ray.inverse.z, 0.0f);
    ivec2 x = ivec2(rayDistance(ray.cell.x, place.cell.x), rayDistance(ray.cell.x, end.x));
    ivec2 y = ivec2(rayDistance(ray.cell.y, place.cell.y), rayDistance(ray.cell.y, end.y));
    ivec2 z = ivec2(rayDistance(ray.cell.z, place.cell.z), rayDistance(ray.cell.z, end.z));
    float tX = rayPlaneT(x.y, ray.start.x, ray.inverse.x);
    float tY = rayPlaneT(y.y, ray.start.y, ray.inverse.y);
    float tZ = rayPlaneT(z.y, ray.start.z, ray.inverse.z);
    if (tX <= tY && tX <= tZ) {
        place.t = tX;
        place.axis = 0;
        place.cell.x = end.x;
        place.cell.y = rayCellAt(ray.cell.y, rayCellAfter(tX, false, y, alongY));
        place.cell.z = rayCellAt(ray.cell.z, rayCellAfter(tX, false, z, alongZ));
    } else if (tY <= tZ) {
        place.t = tY;
        place.axis = 1;
        place.cell.x = rayCellAt(ray.cell.x, rayCellAfter(tY, true, x, alongX));
        place.cell.y = end.y;
        place.cell.z = rayCellAt(ray.cell.z, rayCellAfter(tY, false, z, alongZ));
    } else {
        place.t = tZ;
        place.axis = 2;
        place.cell.x = rayCellAt(ray.cell.x, rayCellAfter(tZ, true, x, alongX));
        place.cell.y = rayCellAt(ray.cell.y, rayCellAfter(tZ, true, y, alongY));
        place.cell.z = end.z;
    }
}

// A ray that begins where another has hit a face: in the cell before that face, on its border.
SHARED_ALWAYS_INLINE Ray rayFromFace(SHARED_REF(Ray) ray, SHARED_REF(RayHit) hit, vec4 direction, float end) {
    int axis = int(hit.face >> 1);
    ivec4 cell = hit.cell ^ ray.mirror;
    vec4 inCell = vec4(0.0f);
    for (int a = 0; a < 3; ++a) {
        SHARED_PRECISE float moved = hit.t * ray.direction[a];
        SHARED_PRECISE float at = (ray.start[a] + moved) - float(rayDistance(ray.cell[a], cell[a]));
        at = a == axis || at > 1.0f ? 1.0f : at < 0.0f ? 0.0f : at;
        SHARED_PRECISE float opposite = 1.0f - at;
        inCell[a] = ray.mirror[a] != 0 ? opposite : at;
    }
    cell[axis] = rayCellAt(cell[axis], -1);
    return makeRay(cell ^ ray.mirror, inCell, direction, end);
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(Ray) == 80 && sizeof(RayPlace) == 32 && sizeof(RayHit) == 32, "as in std430");
}  // namespace terrane::shared
#endif
#endif
