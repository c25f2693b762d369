// Textures of the land around the camera, for lighting: heights hidden from the sun or moon, visible share of
// the sky, and color of the ground.
#ifndef TERRANE_SHARED_LAND_H
#define TERRANE_SHARED_LAND_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Level l has texels of 2^(l + 3) blocks, the columns of the generator's level l + 3; a texel is at most 1/48
// rad wide at the distance where its level begins to be used. The coarsest reaches 114,688 blocks.
const uint kLandLevels = 8u;

// A level's middle part is used, up to this share of its half side; its outermost texels hold the next
// level's values, so that no ring is visible where levels change.
const float kLandUsed = 0.9375f;  // 120 of 128 texels

// The shadow texture. Red: height above which some of the light is visible, a share of LandFrame::heights;
// green: blocks above it until all of the light is, a share of kLandMaxEdge. The heights reach kLandBeyond
// blocks below and above the world. 16 bits a channel as long as a step of the height is at most 1/32 block,
// which is 1/128 in a world of 256 layers, else floats.
const float kLandBeyond = 128.0f;   // blocks
const float kLandMaxEdge = 128.0f;  // blocks

// A level: x, y: texture coordinates of the corner of the camera's chunk; z: texture coordinates a block; w:
// 1 if the level exists, else 0.
struct LandFrame {
    vec4 levels[kLandLevels];
    vec4 heights;  // x: the lowest height; y: blocks from there to the highest; z, w: 0
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(LandFrame) == 16 * (kLandLevels + 1));

constexpr int kLandFirstGeneratorLevel = 3;
}  // namespace terrane::shared
#endif
#endif
