// The geometry of one face of a block shape, and the rule that places a quad's corners with it. The mesher
// names faces by their index in the table of mesh/shape_faces.h; the vertex shader reads the same table and
// calls shapeFaceCorner.
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
const uint kShapeFaceCount = 208u;  // faces of models follow: rectangles in the cell (world/block_model.h)
const uint kMaxShapeFaces = 2048u;  // in all; a quad has 11 bits

// Height of the top of a liquid in its cell, in sixteenths of a block; an integer, since C++ takes no `const
// float` for a constant expression.
const uint kLiquidSurfaceSixteenths = 14u;

// Heights at which the sides of a flowing liquid begin and end: 0 the bottom of the cell, k the height of
// level 8 - k, 8 that of a source, 9 the top of the cell. Each pair has four faces.
const uint kFlowHeights = 9u;
SHARED_FN uint flowSideFace(uint side, uint low, uint high) {
    return kShapeFaceFlowSide + 4u * (high * (high - 1u) / 2u + low) + side;
}

// Units are blocks. A quad repeats the axes extentU and extentV times.
struct ShapeFace {
    vec4 base;    // lowest corner of the face in the cell
    vec4 axisU;   // along the texture's width for one block
    vec4 axisV;   // along the texture's height for one block, upward on upright faces
    vec4 normal;  // outward, axisU × axisV normalized
    // Height of an edge on the surface of a liquid, as a share of the surface's height: base.w at v = 0,
    // axisV.w at v = 1. All other w are 0.
};

// The part of an axis that points toward negative coordinates.
SHARED_FN float negativePart(float a) {
    return a < 0.0f ? a : 0.0f;
}
SHARED_FN vec4 negativePart4(vec4 a) {
    return vec4(negativePart(a.x), negativePart(a.y), negativePart(a.z), negativePart(a.w));
}

// Position of a corner of a quad. `cell` is the quad's lowest block, `corner` is 0 or 1 along u and v,
// `extent` is the quad's size in blocks. Axes that point toward negative coordinates start from the far side,
// so that the quad covers the cells from `cell` upward whichever way its texture runs.
SHARED_FN vec4 shapeFaceCorner(ShapeFace face, vec4 cell, vec2 corner, vec2 extent) {
    vec4 alongU = face.axisU * (corner.x * extent.x) - negativePart4(face.axisU) * extent.x;
    vec4 alongV = face.axisV * (corner.y * extent.y) - negativePart4(face.axisV) * extent.y;
    return cell + face.base + alongU + alongV;
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(ShapeFace) == 64, "four vec4 in std430");
static_assert(kShapeFaceFlowSide + 4 * kFlowHeights * (kFlowHeights + 1) / 2 == kShapeFaceCount);
}  // namespace terrane::shared
#endif
#endif
