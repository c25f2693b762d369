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

SHARED_BEGIN

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

// Cells are within this many blocks of the first one, so that float holds distances between planes exactly.
const int kRayReach = 1 << 23;

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

// The cell along an axis after a plane of another axis was passed at `t`: the last one whose own plane comes
// before. `comesFirst`: whether a plane of this axis with an equal t comes before that plane. `guess`, `low`
// and `high`: distances from the first cell; the answer is from low to high.
SHARED_ALWAYS_INLINE int rayCellAfter(float t, bool comesFirst, int guess, ivec2 lowHigh, vec2 startInverse) {
    int at = guess;
    for (; at < lowHigh.y; ++at) {
        float next = rayPlaneT(at + 1, startInverse.x, startInverse.y);
        if (!(next < t || (comesFirst && next == t))) break;
    }
    for (; at > lowHigh.x; --at) {
        float own = rayPlaneT(at, startInverse.x, startInverse.y);
        if (own < t || (comesFirst && own == t)) break;
    }
    return at;
}

// A position computed as start + t · direction is off by less than this share of the distance, plus 1:
// - t is off by at most 5 roundings of 2^-24 (two units in the last place for the inverse, and one rounding
//   each for the difference and the product), the position by 2 more, and comparisons by the same;
// - that is below 16 · 2^-24.
// So it lies in the right cell unless a plane is nearer than that.
const float kRayUncertainty = 1.0f / 1048576.0f;

// Leaves a box of cells that are passed without a look, and enters the cell behind it. `end`: the planes
// where the box ends, mirrored, each beyond the cell of the place.
SHARED_ALWAYS_INLINE void rayLeaveBox(SHARED_REF(Ray) ray, SHARED_INOUT(RayPlace) place, ivec4 end) {
    int lowX = place.cell.x - ray.cell.x, lowY = place.cell.y - ray.cell.y, lowZ = place.cell.z - ray.cell.z;
    int endX = end.x - ray.cell.x, endY = end.y - ray.cell.y, endZ = end.z - ray.cell.z;
    float tX = rayPlaneT(endX, ray.start.x, ray.inverse.x);
    float tY = rayPlaneT(endY, ray.start.y, ray.inverse.y);
    float tZ = rayPlaneT(endZ, ray.start.z, ray.inverse.z);
    bool isX = tX <= tY && tX <= tZ, isY = !isX && tY <= tZ, isZ = !isX && !isY;
    float t = isX ? tX : isY ? tY : tZ;
    float atX = ray.start.x + t * ray.direction.x, atY = ray.start.y + t * ray.direction.y;
    float atZ = ray.start.z + t * ray.direction.z;
    int x = int(atX), y = int(atY), z = int(atZ);
    float inX = atX - float(x), inY = atY - float(y), inZ = atZ - float(z);
    float offX = kRayUncertainty * (atX + 1.0f), offY = kRayUncertainty * (atY + 1.0f),
          offZ = kRayUncertainty * (atZ + 1.0f);
    bool isUnsure = (!isX && (inX < offX || inX > 1.0f - offX)) ||
                    (!isY && (inY < offY || inY > 1.0f - offY)) ||
                    (!isZ && (inZ < offZ || inZ > 1.0f - offZ));
    if (isUnsure) {
        x = x < lowX ? lowX : x > endX - 1 ? endX - 1 : x;
        y = y < lowY ? lowY : y > endY - 1 ? endY - 1 : y;
        z = z < lowZ ? lowZ : z > endZ - 1 ? endZ - 1 : z;
        x = rayCellAfter(t, true, x, ivec2(lowX, endX - 1), vec2(ray.start.x, ray.inverse.x));
        y = rayCellAfter(t, isZ, y, ivec2(lowY, endY - 1), vec2(ray.start.y, ray.inverse.y));
        z = rayCellAfter(t, false, z, ivec2(lowZ, endZ - 1), vec2(ray.start.z, ray.inverse.z));
    }
    place.cell =
        ivec4(ray.cell.x + (isX ? endX : x), ray.cell.y + (isY ? endY : y), ray.cell.z + (isZ ? endZ : z), 0);
    place.t = t;
    place.axis = isX ? 0 : isY ? 1 : 2;
}

// A ray that begins where another has hit a face: in the cell before that face, on its border.
SHARED_ALWAYS_INLINE Ray rayFromFace(SHARED_REF(Ray) ray, SHARED_REF(RayHit) hit, vec4 direction, float end) {
    int axis = int(hit.face >> 1);
    ivec4 cell = hit.cell ^ ray.mirror;
    vec4 inCell = vec4(0.0f);
    for (int a = 0; a < 3; ++a) {
        SHARED_PRECISE float moved = hit.t * ray.direction[a];
        SHARED_PRECISE float at = (ray.start[a] + moved) - float(cell[a] - ray.cell[a]);
        at = at < 0.0f ? 0.0f : at > 1.0f ? 1.0f : at;
        if (a == axis) at = 1.0f;
        SHARED_PRECISE float opposite = 1.0f - at;
        inCell[a] = ray.mirror[a] != 0 ? opposite : at;
    }
    cell[axis] -= 1;
    return makeRay(cell ^ ray.mirror, inCell, direction, end);
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(Ray) == 80 && sizeof(RayPlace) == 32 && sizeof(RayHit) == 32, "as in std430");
}  // namespace terrane::shared
#endif
#endif
