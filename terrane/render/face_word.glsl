// What a fragment must know of its quad, in one word: bits 0–11 texture, 12–14 alpha mode, 15–17 direction, 18 whether it
// is the surface of a liquid, 19–23 and 24–28 extents less one. Needs quad.h, shape_face.h, frame.h.
#include "terrane/shared/material.h"
#include "terrane/render/surface_word.glsl"

uint directionOf(uint shapeFace) {
    if (shapeFace < kShapeFaceCross) return shapeFace;
    if (shapeFace < kShapeFaceInset) return kDirectionPlant;
    if (shapeFace < kShapeFaceLiquidTop) return shapeFace - kShapeFaceInset;
    return shapeFace == kShapeFaceLiquidTop ? 5u : shapeFace - kShapeFaceLiquidSide;
}

uint faceWord(Quad quad, MaterialRecord material) {
    uint isLiquid = material.animation == kAnimationLiquidSurface ? 1u : 0u;
    return material.texture | material.alphaMode << 12 | directionOf(quadShapeFace(quad)) << 15 | isLiquid << 18 |
           (quadExtentU(quad) - 1u) << 19 | (quadExtentV(quad) - 1u) << 24;
}
