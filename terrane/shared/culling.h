// The rules of culling, on the GPU (render/cull/*.comp.glsl) and on the CPU (render/cull/cpu_view.cpp): which
// boxes and quads lie outside the view, where they are in the image, and which texels of Hi-Z may hide them.
// Positions are in blocks from the corner of the camera's chunk, places in the image in pixels from its lower
// left corner.
#ifndef TERRANE_SHARED_CULLING_H
#define TERRANE_SHARED_CULLING_H

#include "terrane/shared/constants.h"
#include "terrane/shared/language.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/shared/quad.h"
#include "terrane/shared/shape_face.h"

#ifdef __cplusplus
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/integer.hpp>
#include <glm/vec3.hpp>
#endif

SHARED_BEGIN
#ifdef __cplusplus
using glm::abs;
using glm::ceil;
using glm::clamp;
using glm::dot;
using glm::findMSB;
using glm::floor;
using glm::max;
using glm::min;
using glm::sqrt;
using glm::vec3;
#endif

// Where a box or a quad is in the image, and how near.
struct Footprint {
    vec2 low, high;
    float nearest;  // depth of the nearest corner
    uint isBefore;  // 1 if all corners are in front of the camera; else the rest has no meaning
    uint isBack;    // 1 for the back side of a face that is not drawn
    uint unused;
};

// Texels of a level of Hi-Z.
struct HiZArea {
    ivec2 first, last;
    int level, unused;
};

SHARED_INLINE bool isOutside(vec4 plane, vec3 low, vec3 high) {
    return max(plane.x * low.x, plane.x * high.x) + max(plane.y * low.y, plane.y * high.y) +
               max(plane.z * low.z, plane.z * high.z) + plane.w <
           0.0f;
}

// Face directions that the camera may see of the faces in a box, a bit each: all faces toward -x are seen
// from behind if the camera is beyond the last of them, and so on. The last direction is that of oblique and
// two-sided faces.
SHARED_FN uint facingDirections(vec3 camera, vec3 low, vec3 high) {
    return uint(camera.x < high.x) | uint(camera.x > low.x) << 1 | uint(camera.y < high.y) << 2 |
           uint(camera.y > low.y) << 3 | uint(camera.z < high.z) << 4 | uint(camera.z > low.z) << 5 | 1u << 6;
}

// A point in clip space, or with w 0 a direction. Its columns one after the other, for vector units.
SHARED_INLINE vec4 toClip(mat4 viewProjection, vec4 at) {
    return viewProjection[0] * at.x + viewProjection[1] * at.y + viewProjection[2] * at.z +
           viewProjection[3] * at.w;
}

SHARED_INLINE vec2 inImage(vec4 clip, vec2 viewport) {
    return (0.5f + 0.5f * vec2(clip.x, clip.y) / clip.w) * viewport;
}

SHARED_INLINE Footprint footprintOfBox(SHARED_REF(CullView) view, vec3 low, vec3 high) {
    Footprint print;
    print.low = vec2(1e9f);
    print.high = vec2(-1e9f);
    print.nearest = 0.0f;
    print.isBefore = 0u;
    print.isBack = 0u;
    print.unused = 0u;
    vec4 corner = toClip(view.viewProjection, vec4(low, 1.0f));
    for (int k = 0; k < 8; ++k) {
        vec4 clip = corner;
        if ((k & 1) != 0) clip += view.viewProjection[0] * (high.x - low.x);
        if ((k & 2) != 0) clip += view.viewProjection[1] * (high.y - low.y);
        if ((k & 4) != 0) clip += view.viewProjection[2] * (high.z - low.z);
        if (clip.w <= 2.0f * view.nearPlane) return print;
        vec2 at = inImage(clip, view.viewportSize);
        print.low = min(print.low, at);
        print.high = max(print.high, at);
        print.nearest = max(print.nearest, view.nearPlane / clip.w);
    }
    // One more pixel on each side, since quads grow a little.
    print.low -= 1.0f;
    print.high += 1.0f;
    print.isBefore = 1u;
    return print;
}

const float kQuadRounding = 1.0f / 64.0f;  // pixels

// Twice the area in the image, pixels², below which a face seen from behind is taken for one seen edge-on:
// edges move a little.
const float kLeastBack = 1.0f;

// A quad of a chunk. `slabCorner`: of the chunk, at the lowest layer of the quad's slab. `isTwoSided`: of its
// bucket.
SHARED_INLINE Footprint footprintOfQuad(SHARED_REF(CullView) view, Quad quad, ShapeFace shape, bool isWaving,
                                        bool isTwoSided, vec3 slabCorner, float columnWidth) {
    vec2 extent = vec2(float(quadExtentU(quad)), float(quadExtentV(quad)));
    vec4 cellBlocks = vec4(columnWidth, columnWidth, 1.0f, 0.0f);
    vec4 cell = vec4(float(quadX(quad)), float(quadY(quad)), float(quadZ(quad)), 0.0f);
    vec4 corner = cellBlocks * shapeFaceCorner(shape, cell, vec2(0.0f), extent) + vec4(slabCorner, 1.0f);
    vec4 clip0 = toClip(view.viewProjection, corner);
    vec4 alongU = toClip(view.viewProjection, cellBlocks * shape.axisU * extent.x);
    vec4 alongV = toClip(view.viewProjection, cellBlocks * shape.axisV * extent.y);
    vec4 clip1 = clip0 + alongU, clip2 = clip0 + alongV, clip3 = clip1 + alongV;
    if (quadShapeFace(quad) >= kShapeFaceCount) clip3 += toClip(view.viewProjection, cellBlocks * shape.bend);
    // Waving faces may move in every direction. The vertex shader reads the same materials.
    float waving = isWaving ? kWaving : 0.0f;
    float least = min(min(clip0.w, clip1.w), min(clip2.w, clip3.w)) - waving;
    Footprint print;
    print.isBefore = uint(least > 2.0f * view.nearPlane);
    vec2 at0 = inImage(clip0, view.viewportSize), at1 = inImage(clip1, view.viewportSize);
    vec2 at2 = inImage(clip2, view.viewportSize), at3 = inImage(clip3, view.viewportSize);
    // Edges move outward, farther at sharp corners. Twice that is used, since corners differ.
    vec2 u = at1 - at0, v = at2 - at0;
    float lengths = max(sqrt(dot(u, u) * dot(v, v)), 1e-12f);
    float turn = u.x * v.y - u.y * v.x;  // twice the area, negative from behind
    float sine = abs(turn) / lengths;
    float margin = kQuadRounding + 4.0f * view.edgeExpansion * min(1.0f / max(sine, 1e-6f), kLongestMiter) +
                   waving * view.blockPixels / max(least, view.nearPlane);
    print.low = min(min(at0, at1), min(at2, at3)) - margin;
    print.high = max(max(at0, at1), max(at2, at3)) + margin;
    print.nearest = 1.0001f * view.nearPlane / max(least, view.nearPlane);
    bool hidesBack = isTwoSided ? view.hidesBacks != 0u : !isWaving;
    print.isBack = uint(hidesBack && quadShapeFace(quad) < kShapeFaceCross && turn < -kLeastBack);
    print.unused = 0u;
    return print;
}

SHARED_INLINE bool isInView(SHARED_REF(CullView) view, Footprint print, float margin) {
    return print.high.x >= -margin && print.high.y >= -margin &&
           print.low.x <= view.viewportSize.x + margin && print.low.y <= view.viewportSize.y + margin;
}

// With one sample a pixel is drawn if its center is covered.
SHARED_INLINE bool hasSample(SHARED_REF(CullView) view, Footprint print) {
    return view.samples > 1u || (ceil(print.low.x - 0.5f) <= floor(print.high.x - 0.5f) &&
                                 ceil(print.low.y - 0.5f) <= floor(print.high.y - 0.5f));
}

// The texels of a level that cover the footprint.
SHARED_INLINE HiZArea hiZArea(SHARED_REF(CullView) view, Footprint print, int level) {
    vec2 end = view.viewportSize - 1.0f;
    vec2 low = clamp(print.low, vec2(0.0f), end), high = clamp(print.high, vec2(0.0f), end);
    HiZArea area;
    area.first = ivec2(low) / int(kHiZTexelPixels) >> level;
    area.last = ivec2(high) / int(kHiZTexelPixels) >> level;
    area.level = level;
    area.unused = 0;
    return area;
}

// The finest level at which few texels cover a box: far land is wide and flat.
SHARED_INLINE HiZArea hiZAreaOfBox(SHARED_REF(CullView) view, Footprint print) {
    const int kMaxTexels = 64;
    HiZArea area = hiZArea(view, print, 0);
    for (int level = 1; level < view.hiZLevels; ++level) {
        ivec2 size = area.last - area.first + 1;
        if (size.x * size.y <= kMaxTexels) break;
        area = hiZArea(view, print, level);
    }
    return area;
}

// The level at which two or three texels along a side cover a quad, or one.
SHARED_INLINE HiZArea hiZAreaOfQuad(SHARED_REF(CullView) view, Footprint print) {
    HiZArea area = hiZArea(view, print, 0);
    ivec2 size = area.last - area.first;
    return hiZArea(view, print, clamp(findMSB(max(max(size.x, size.y), 1)), 0, view.hiZLevels - 1));
}

// Quads hidden by less than this share of their distance, or this little outside the image, may become
// visible in the next frames: the early pass draws them, so that the late pass has less to draw.
const float kSoon = 0.99f;
const float kSoonPixels = 32.0f;

// Whether a quad before the camera can be seen now, and whether it may be soon. `farthest`: of the texels of
// hiZAreaOfQuad().
SHARED_INLINE bool isQuadVisible(SHARED_REF(CullView) view, Footprint print, float farthest) {
    return print.isBack == 0u && isInView(view, print, 0.0f) && hasSample(view, print) &&
           !(print.nearest < farthest);
}
SHARED_INLINE bool isQuadVisibleSoon(SHARED_REF(CullView) view, Footprint print, float farthest) {
    return print.isBack == 0u && isInView(view, print, kSoonPixels) && !(print.nearest < kSoon * farthest);
}

SHARED_END
#endif
