// The geometry and the texture coordinates of one face of a block shape, and the rule that places a quad's
// corners with it. The mesher names faces by their index in the table of mesh/shape_faces.h; the vertex
// shader reads the same table and calls shapeFaceCorner.
#ifndef TERRANE_SHARED_SHAPE_FACE_H
#define TERRANE_SHARED_SHAPE_FACE_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Indices of the table. Where four or six follow each other they are in the order -x, +x, -y, +y (, -z, +z).
const uint kShapeFaceCube = 0u;         // 0–5   the sides of the cell
const uint kShapeFaceCross = 6u;        // 6–7   two upright diagonal planes
const uint kShapeFaceHash = 8u;         // 8–11  upright planes a quarter inside the cell
const uint kShapeFaceInset = 12u;       // 12–15 upright planes 1/16 inside the cell
const uint kShapeFaceLiquidTop = 16u;   // 16    the lowered top of a liquid
const uint kShapeFaceLiquidSide = 17u;  // 17–20 the sides under that top
const uint kShapeFaceFlowTop = 21u;     // 21–27 the tops of a liquid at its levels 1–7
const uint kShapeFaceFlowSide = 28u;    // 28–207 sides of a liquid that flows, see flowSideFace
const uint kShapeFaceCount = 208u;      // faces of models follow (world/blocks/block_model.h)
const uint kMaxShapeFaces = 2048u;      // in all; a quad has 11 bits

// Height of the top of a liquid in its cell, in sixteenths of a block; an integer, since C++ takes no `const
// float` for a constant expression.
const uint kLiquidSurfaceSixteenths = 14u;

// Heights at which the sides of a flowing liquid begin and end: 0 the bottom of the cell, k the height of
// level 8 - k, 8 that of a source, 9 the top of the cell. Each pair has four faces.
const uint kFlowHeights = 9u;
SHARED_FN uint flowSideFace(uint side, uint low, uint high) {
    return kShapeFaceFlowSide + 4u * (high * (high - 1u) / 2u + low) + side;
}

// Directions of faces: 0–5 along an axis, in the order above. Oblique faces have none and are lit like the
// ground below them; so are the upright planes of plants.
const uint kDirectionPlant = 6u;

// A quad with its own texture coordinates. Units are blocks. Corners 0, 1, 2 and 3 are at (0, 0), (1, 0),
// (0, 1) and (1, 1) along u and v. A quad of several blocks repeats the axes; only faces without bend merge.
// The w of each part holds the texture coordinates of one corner and a property of the face
// (packFacePart): so a face takes 64 bytes, and the vertex shader reads 48 of them where nothing is bent.
struct ShapeFace {
    vec4 base;   // lowest corner of the parallelogram of the axes; w: corner 0, share of the surface at v = 0
    vec4 axisU;  // along the texture's width for one block; w: corner 1, direction
    vec4 axisV;  // along its height, upward on upright faces; w: corner 2, share of the surface at v = 1
    vec4 bend;   // from that parallelogram to corner 3; w: corner 3, whether the face is two-sided
};

// Texture coordinates have 256 steps a texture, from its upper left corner. With 9 bits each and 4 bits for
// the property, a float of 24 bits holds them exactly.
const uint kTexelUnits = 256u;

SHARED_FN float packFacePart(uint u, uint v, uint property) {
    return float(u | v << 9 | property << 18);
}
SHARED_FN uint facePartProperty(vec4 part) {
    return uint(part.w) >> 18;
}
SHARED_FN vec2 facePartTexel(vec4 part) {
    uint bits = uint(part.w);
    return vec2(float(bits & 511u), float(bits >> 9 & 511u)) / float(kTexelUnits);
}

// The bend of all faces before kShapeFaceCount: corner 3 has the texture's upper right corner.
SHARED_FN vec4 flatBend() {
    return vec4(0.0f, 0.0f, 0.0f, packFacePart(kTexelUnits, 0u, 0u));
}

SHARED_FN uint faceDirectionOf(ShapeFace face) {
    return facePartProperty(face.axisU);
}
SHARED_FN bool isTwoSidedFace(ShapeFace face) {
    return facePartProperty(face.bend) != 0u;
}

// Height of an edge on the surface of a liquid, as a share of the surface's height: of base at v = 0, of
// axisV at v = 1. 0 if the edge is not on the surface.
SHARED_FN float surfaceShareOf(vec4 part) {
    return float(facePartProperty(part)) / float(kFlowHeights - 1u);
}

// Texture coordinates of a corner, 0 to 1.
SHARED_FN vec2 shapeFaceTexel(ShapeFace face, vec2 corner) {
    if (corner.y == 0.0f) return facePartTexel(corner.x == 0.0f ? face.base : face.axisU);
    return facePartTexel(corner.x == 0.0f ? face.axisV : face.bend);
}

// The part of an axis that points toward negative coordinates.
SHARED_FN float negativePart(float a) {
    return a < 0.0f ? a : 0.0f;
}
SHARED_FN vec4 negativePart4(vec4 a) {
    return vec4(negativePart(a.x), negativePart(a.y), negativePart(a.z), negativePart(a.w));
}

// Position of a corner of a quad; w has no meaning. `cell` is the quad's lowest block, `corner` is 0 or 1
// along u and v, `extent` is the quad's size in blocks. Axes that point toward negative coordinates start
// from the far side, so that the quad covers the cells from `cell` upward whichever way its texture runs.
SHARED_FN vec4 shapeFaceCorner(ShapeFace face, vec4 cell, vec2 corner, vec2 extent) {
    vec4 alongU = face.axisU * (corner.x * extent.x) - negativePart4(face.axisU) * extent.x;
    vec4 alongV = face.axisV * (corner.y * extent.y) - negativePart4(face.axisV) * extent.y;
    return cell + face.base + alongU + alongV + face.bend * (corner.x * corner.y);
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(ShapeFace) == 64, "four vec4 in std430");
static_assert(packFacePart(kTexelUnits, kTexelUnits, 15) < 16777216.0f, "a float counts to 2^24");
static_assert(kShapeFaceFlowSide + 4 * kFlowHeights * (kFlowHeights + 1) / 2 == kShapeFaceCount);
}  // namespace terrane::shared
#endif
#endif
