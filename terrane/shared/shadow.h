// The shadow cascades as shaders read them and as they are drawn.
#ifndef TERRANE_SHARED_SHADOW_H
#define TERRANE_SHARED_SHADOW_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Cascades are squares across the light, each four times as wide as the one before, in kShadowTiles ×
// kShadowTiles tiles of texels. A point of a cascade is found in its map by its place modulo the map's width.
const uint kShadowCascades = 3u;
const uint kShadowTiles = 8u;

// Blocks along the light that all maps hold, half of them on each side of the anchor: depths of 32 bits are
// exact to 1/2000 block. Casters beyond are clamped into the range. Receivers are at most some 800 blocks
// from the camera, which is at most 1,024 √2 blocks over the ground and 2,048 in height from the anchor.
const float kShadowRange = 8192.0f;

// Transforms from positions of the frame (see Frame) to the maps. Cascades differ in the direction of the
// light while a new map is being drawn for another direction.
struct ShadowFrame {
    vec4 toMap[9];  // three rows for each cascade: x and y in widths of the map, not wrapped; depth, 1 toward
                    // the light
    // x, y, z of each cascade:
    vec4 reach;       // 1 / blocks from the camera that it holds
    vec4 layers;      // its map
    vec4 texels;      // blocks a texel; w: most texels to each side of a soft edge
    float strength;   // 0 if no light casts shadows
    float mapTexels;  // along a side of a map
    float unused0, unused1;
};

// For drawing a rectangle of tiles. Positions count from the corner of the anchor's chunk: they do not depend
// on the camera.
struct ShadowDraw {
    mat4 toClip;
    vec4 toLight;  // unit length; w is 0
    ivec2 anchorChunk;
    ivec2 unused;
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(ShadowFrame) == (9 + 4) * 16);
static_assert(sizeof(ShadowDraw) == 96);
}  // namespace terrane::shared
#endif
#endif
